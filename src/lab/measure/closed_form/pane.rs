//! What panes of glass let through, how far they shift it, and what ink leaves of it: Fresnel, Snell, Beer.

use super::{ClosedForm, GREEN};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::material::fresnel;
use pinhole::scene::{
    Cuboid, Emissive, Glass, Integrator, LightStrategy, LookAt, OrthographicCamera, Placement, Rgb, Sphere,
};
use std::f64::consts::{FRAC_PI_3, FRAC_PI_4, LN_2, PI};

/// What a ball of radius 1 leaves of parallel light, all of it together, where it absorbs 1 over a way of 1.
const INK: f64 = 1.0;

pub(super) const FORMS: &[ClosedForm] = &[
    ClosedForm {
        name: "light through a pane, normal incidence",
        formula: "(1 − R) / (1 + R)",
        truth: || through(0.04),
        few: 1 << 12,
        component: GREEN,
        scene: |world| through_a_pane(world, 0.0),
    },
    ClosedForm {
        name: "light through a pane at 60°",
        formula: "(1 − R) / (1 + R)",
        truth: || through(fresnel(0.5, 1.5)),
        few: 1 << 13,
        component: GREEN,
        scene: |world| through_a_pane(world, FRAC_PI_3),
    },
    ClosedForm {
        name: "a pane at 60° shifts an edge, once through",
        formula: "(1 − R)² (1/2 + shift / height)",
        truth: || {
            let (sin, cos) = libm::sincos(FRAC_PI_3);
            // Snell: d = t sin θ (1 − cos θ / √(η² − sin² θ)), for a thickness of 2.
            let shift = 2.0 * sin * (1.0 - cos / (2.25 - sin * sin).sqrt());
            let once = 1.0 - fresnel(cos, 1.5);
            once * once * (0.5 + shift / 4.0)
        },
        few: 1 << 15,
        component: GREEN,
        scene: |world| {
            look(world, FRAC_PI_3, 4.0, 3);
            pane(world, Glass::default());
            // Without the pane the middle of the view would see the edge.
            panel(world, 5.0 * libm::tan(-FRAC_PI_3), -5.0);
        },
    },
    ClosedForm {
        name: "a pane at 60° with ink, once through",
        formula: "(1 − R)² e^(−σ t / cos θ′)",
        truth: || {
            let (sin, cos) = libm::sincos(FRAC_PI_3);
            let once = 1.0 - fresnel(cos, 1.5);
            once * once * libm::exp(-0.5 * 2.0 / (1.0 - sin * sin / 2.25).sqrt())
        },
        few: 1 << 14,
        component: GREEN,
        scene: |world| {
            look(world, FRAC_PI_3, 0.1, 3);
            pane(world, Glass { absorption: Rgb::grey(0.5), ..Glass::default() });
            panel(world, -50.0, -5.0);
        },
    },
    ClosedForm {
        name: "off the side of a block, none gets out there",
        formula: "(1 − R)²",
        truth: || {
            let once = 1.0 - fresnel(libm::cos(FRAC_PI_4), 1.5);
            once * once
        },
        few: 1 << 12,
        component: GREEN,
        scene: |world| {
            // In at 45° through the top, 2 wide, off the side at x = −1, out below; what the side let through would go past
            // the panel.
            look(world, FRAC_PI_4, 0.1, 4);
            let block = Cuboid { size: DVec3::new(2.0, 9.0, 3.0) };
            world.spawn((block, Glass::default(), Placement::at(0.0, 0.0, -1.5)));
            panel(world, 0.0, -5.0);
        },
    },
    ClosedForm {
        name: "coloured ink, red",
        formula: "e^(−σ length)",
        truth: || 0.25,
        few: 1 << 11,
        component: 0,
        scene: coloured,
    },
    ClosedForm {
        name: "coloured ink, green",
        formula: "e^(−σ length)",
        truth: || 0.5,
        few: 1 << 11,
        component: GREEN,
        scene: coloured,
    },
    ClosedForm {
        name: "coloured ink, blue",
        formula: "e^(−σ length)",
        truth: || 1.0,
        few: 1 << 11,
        component: 2,
        scene: coloured,
    },
    ClosedForm {
        name: "a ball of ink before a wall of light",
        formula: "1 − (π/4) (1 − (1 − (1 + 2σ) e^(−2σ)) / 2σ²)",
        truth: || {
            let left = (1.0 - (1.0 + 2.0 * INK) * libm::exp(-2.0 * INK)) / (2.0 * INK * INK);
            1.0 - 0.25 * PI * (1.0 - left)
        },
        few: 1 << 13,
        component: GREEN,
        scene: |world| {
            look(world, 0.0, 2.0, 3);
            let ink = Glass { ior: 1.0, absorption: Rgb::grey(INK), ..Glass::default() };
            world.spawn((Sphere { radius: 1.0 }, ink));
            panel(world, -50.0, -5.0);
        },
    },
];

/// The transmittance of two faces of this reflectance, with all turns between them: (1 − R)² (1 + R² + R⁴ + …).
///
/// Light is taken to swing both ways alike at each face, as pinhole has it; in truth it leaves the first one polarised.
fn through(reflected: f64) -> f64 {
    (1.0 - reflected) / (1.0 + reflected)
}

fn through_a_pane(world: &mut World, angle: f64) {
    look(world, angle, 0.1, 1 << 16);
    pane(world, Glass::default());
    panel(world, -50.0, -5.0);
}

/// Red loses three quarters over the pane's thickness of 2, green half, blue nothing.
fn coloured(world: &mut World) {
    look(world, 0.0, 0.1, 3);
    pane(world, Glass { ior: 1.0, absorption: Rgb::new(LN_2, 0.5 * LN_2, 0.0), ..Glass::default() });
    panel(world, -50.0, -5.0);
}

/// A camera with parallel rays through the origin, at this angle to −z and towards −x.
fn look(world: &mut World, angle: f64, view_height: f64, max_depth: u32) {
    let (sin, cos) = libm::sincos(angle);
    let look = LookAt { eye: 10.0 * DVec3::new(sin, 0.0, cos), target: DVec3::ZERO, ..LookAt::default() };
    let paths = Integrator::Path { max_depth, lights: LightStrategy::Bsdf, roulette: 0 };
    world.spawn((OrthographicCamera { view_height }, look, paths));
}

/// A pane from z = −1 to z = 1.
fn pane(world: &mut World, glass: Glass) {
    world.spawn((Cuboid { size: DVec3::new(50.0, 50.0, 2.0) }, glass));
}

/// A panel that shines with 1, from an edge on towards +x, with its face up.
fn panel(world: &mut World, edge: f64, face: f64) {
    let size = DVec3::new(100.0, 100.0, 1.0);
    let light = Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() };
    world.spawn((Cuboid { size }, Placement::at(edge + 50.0, 0.0, face - 0.5), light));
}
