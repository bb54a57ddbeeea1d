//! Mirrors, glass and metal under a sky of radiance 1.

use super::{ClosedForm, GREEN};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::material::fresnel;
use pinhole::scene::{
    Background, BlinnPhong, Cuboid, Glass, Integrator, LightStrategy, LookAt, Metal, Mirror, OrthographicCamera,
    PerspectiveCamera, Phong, Placement, Plane, Rgb, Sphere,
};
use std::f64::consts::{FRAC_PI_3, LN_2};

/// Paths without Russian roulette, so that where both media and all angles are known nothing is random.
const PATHS: Integrator = Integrator::Path { max_depth: 1 << 16, lights: LightStrategy::Bsdf, roulette: 0 };

/// Metal that loses nothing at a single reflection.
const BRIGHT: Metal = Metal { colour: Rgb::grey(1.0), roughness: 0.0, multiple_scattering: false };

/// The reflectance of glass of index 1.5 at normal incidence.
const NORMAL_INCIDENCE: f64 = 0.04;

pub(super) const FORMS: &[ClosedForm] = &[
    ClosedForm {
        name: "Phong in an even sky, from above",
        formula: "colour + specular",
        truth: || 0.7,
        few: 1 << 13,
        component: GREEN,
        scene: |world| {
            from_above(world, Phong { colour: Rgb::grey(0.4), specular: Rgb::grey(0.3), exponent: 40.0 });
        },
    },
    ClosedForm {
        name: "Blinn–Phong in an even sky, from above",
        formula: "colour + specular",
        truth: || 0.7,
        few: 1 << 13,
        component: GREEN,
        scene: |world| {
            from_above(world, BlinnPhong { colour: Rgb::grey(0.4), specular: Rgb::grey(0.3), exponent: 40.0 });
        },
    },
    ClosedForm {
        name: "two mirrors in a row, 0.9 and 0.8",
        formula: "c₁ c₂",
        truth: || 0.72,
        few: 1 << 10,
        component: GREEN,
        scene: |world| {
            // The first turns the view upward, the second sends it to the side, and upward still.
            view(world, 20.0 * DVec3::Z, 0.1);
            let tilted = |normal: DVec3, colour| (Plane { normal }, Mirror { colour: Rgb::grey(colour) });
            world.spawn(tilted(DVec3::new(0.0, 1.0, 1.0), 0.9));
            world.spawn((tilted(DVec3::new(3.0, -1.0, 0.0), 0.8), Placement::at(0.0, 40.0, 0.0)));
        },
    },
    ClosedForm {
        name: "a ball of glass in an even sky",
        formula: "1",
        truth: || 1.0,
        few: 1 << 12,
        component: GREEN,
        scene: |world| {
            world.spawn((PerspectiveCamera::default(), Placement::at(0.0, 0.0, 2.5), PATHS));
            world.spawn(Background { colour: Rgb::grey(1.0) });
            world.spawn((Sphere { radius: 1.0 }, Glass::default()));
        },
    },
    ClosedForm {
        name: "from within a tinted ball, index 1",
        formula: "e^(−σ R)",
        truth: || libm::exp(-0.5),
        few: 1 << 10,
        component: GREEN,
        scene: |world| {
            world.spawn((PerspectiveCamera::default(), Placement::default(), PATHS));
            world.spawn(Background { colour: Rgb::grey(1.0) });
            world.spawn((Sphere { radius: 1.0 }, Glass { ior: 1.0, absorption: Rgb::grey(0.5), priority: 0 }));
        },
    },
    ClosedForm {
        name: "glass without end at 60°, index 1.5",
        formula: "F + (1 − F) / η²",
        truth: || {
            let reflected = fresnel(libm::cos(FRAC_PI_3), 1.5);
            reflected + (1.0 - reflected) / 2.25
        },
        few: 1 << 16,
        component: GREEN,
        scene: |world| {
            view(world, 20.0 * DVec3::new(libm::sin(FRAC_PI_3), 0.0, libm::cos(FRAC_PI_3)), 1.0);
            world.spawn((Plane { normal: DVec3::Z }, Glass::default()));
        },
    },
    ClosedForm {
        name: "an absorbing pane, half of the light lost",
        formula: "R + (1 − R)² t (1 + R t) / (1 − R² t²)",
        truth: || {
            let (r, t) = (NORMAL_INCIDENCE, 0.5);
            r + (1.0 - r) * (1.0 - r) * t * (1.0 + r * t) / (1.0 - r * r * t * t)
        },
        few: 1 << 16,
        component: GREEN,
        scene: |world| {
            view(world, 20.0 * DVec3::Z, 1.0);
            let absorption = Rgb::grey(0.5 * LN_2);
            pane(world, Glass { absorption, ..Glass::default() }, [-1.0, 1.0]);
        },
    },
    ClosedForm {
        name: "two drinks that overlap, the first there",
        formula: "e^(−Σ σ length)",
        truth: || libm::exp(-1.0),
        few: 1 << 10,
        component: GREEN,
        scene: |world| {
            // From near by: a ray starts off its surface by the bound, which grows with the distance from the eye, and
            // that much of its path is not counted.
            view(world, 1.5 * DVec3::Z, 1.0);
            let drink = |absorption, priority| Glass { ior: 1.0, absorption: Rgb::grey(absorption), priority };
            pane(world, drink(0.2, 1), [-1.0, 1.0]);
            pane(world, drink(0.3, 0), [-3.0, 0.0]);
        },
    },
    ClosedForm {
        name: "a drink in a thick glass, no gap of air",
        formula: "R + (1 − R)² r / (1 − R r)",
        truth: layers,
        few: 1 << 19,
        component: GREEN,
        scene: |world| {
            view(world, 20.0 * DVec3::Z, 1.0);
            // Seen through, nothing would be lost; a dark drink shows how much of the light comes from it.
            let drink = Glass { ior: 1.3, absorption: Rgb::grey(1e9), priority: 0 };
            pane(world, Glass { priority: 1, ..Glass::default() }, [-1.0, 1.0]);
            pane(world, drink, [-9.0, 0.0]);
        },
    },
    ClosedForm {
        name: "rough metal, α = 1, seen along its normal",
        formula: "1 − ln 2",
        truth: || 1.0 - LN_2,
        few: 1 << 17,
        component: GREEN,
        scene: |world| {
            view(world, 20.0 * DVec3::Z, 1.0);
            world.spawn((Plane { normal: DVec3::Z }, Metal { roughness: 1.0, ..BRIGHT }));
        },
    },
    ClosedForm {
        name: "rough metal, α = 1, multiple scattering",
        formula: "1",
        truth: || 1.0,
        few: 1 << 17,
        component: GREEN,
        scene: |world| {
            view(world, 20.0 * DVec3::Z, 1.0);
            world.spawn((Plane { normal: DVec3::Z }, Metal { multiple_scattering: true, roughness: 1.0, ..BRIGHT }));
        },
    },
];

/// What comes back from a wall of glass before a drink in which all light is lost: off the outer face, and off the inner
/// one after any number of turns within the wall.
fn layers() -> f64 {
    let (outer, inner) = (NORMAL_INCIDENCE, fresnel(1.0, 1.3 / 1.5));
    outer + (1.0 - outer) * (1.0 - outer) * inner / (1.0 - outer * inner)
}

/// A camera whose rays are parallel, looking at the origin, under the sky.
fn view(world: &mut World, eye: DVec3, view_height: f64) {
    let look = LookAt { eye, target: DVec3::ZERO, ..LookAt::default() };
    world.spawn((OrthographicCamera { view_height }, look, PATHS));
    world.spawn(Background { colour: Rgb::grey(1.0) });
}

/// A plane of a material, seen along its normal.
fn from_above(world: &mut World, material: impl Component) {
    view(world, 20.0 * DVec3::Z, 0.1);
    world.spawn((Plane { normal: DVec3::Z }, material));
}

/// A wide pane of glass across the view, from one z to another.
fn pane(world: &mut World, glass: Glass, [low, high]: [f64; 2]) {
    let size = DVec3::new(9.0, 9.0, high - low);
    world.spawn((Cuboid { size }, glass, Placement::at(0.0, 0.0, 0.5 * (low + high))));
}
