//! A closed room whose walls all shine and send light on alike: L = E + aE + a²E + … = E / (1 − a).

use super::{ClosedForm, GREEN};
use bevy_ecs::prelude::*;
use pinhole::scene::{Emissive, Integrator, LightStrategy, Matte, PerspectiveCamera, Placement, Rgb, Sphere};

pub(super) const FORMS: &[ClosedForm] = &[
    ClosedForm {
        name: "furnace, albedo 0.5",
        formula: "1 / (1 − a)",
        truth: || 2.0,
        few: 1 << 14,
        component: GREEN,
        scene: |world| room(world, 0.5, PATHS),
    },
    ClosedForm {
        name: "furnace, albedo 0.8",
        formula: "1 / (1 − a)",
        truth: || 5.0,
        few: 1 << 15,
        component: GREEN,
        scene: |world| room(world, 0.8, PATHS),
    },
    ClosedForm {
        name: "furnace, albedo 0.99",
        formula: "1 / (1 − a)",
        truth: || 1.0 / (1.0 - 0.99),
        few: 1 << 15,
        component: GREEN,
        scene: |world| room(world, 0.99, PATHS),
    },
    ClosedForm {
        name: "furnace, albedo 0.99, at most 64 segments",
        formula: "(1 − a⁶⁴) / (1 − a)",
        truth: || (1.0 - libm::pow(0.99, 64.0)) / (1.0 - 0.99),
        few: 1 << 11,
        component: GREEN,
        scene: |world| {
            room(world, 0.99, Integrator::Path { max_depth: 64, lights: LightStrategy::Bsdf, roulette: 0 });
        },
    },
];

/// Paths that end by Russian roulette alone.
const PATHS: Integrator = Integrator::Path { max_depth: 1 << 20, lights: LightStrategy::Bsdf, roulette: 2 };

/// The camera stands off the middle of a hollow ball.
fn room(world: &mut World, albedo: f64, integrator: Integrator) {
    world.spawn((PerspectiveCamera::default(), Placement::at(0.2, -0.1, 0.3), integrator));
    let wall = (Matte { colour: Rgb::grey(albedo) }, Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() });
    world.spawn((Sphere { radius: 1.0 }, wall));
}
