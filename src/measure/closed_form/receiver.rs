//! What a point of the ground receives of lights that have an area; a matte ground of albedo 1 sends on E / π.

use super::ClosedForm;
use crate::scene::{
    Disk, Emissive, Integrator, LightSampling, LookAt, Matte, OrthographicCamera, Placement, Plane, Rectangle, Rgb,
    Sphere,
};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// A light in the three ways in which its light is found.
macro_rules! found_in_three_ways {
    ($($name:literal, $formula:literal, $truth:expr, $few:expr, $light:expr;)+) => {
        &[$(
            ClosedForm {
                name: concat!($name, ", met by chance"),
                formula: $formula,
                truth: $truth,
                few: $few,
                scene: |world| lit(world, LightSampling::ByChance, $light),
            },
            ClosedForm {
                name: concat!($name, ", aimed at"),
                formula: $formula,
                truth: $truth,
                few: $few,
                scene: |world| lit(world, LightSampling::Aimed, $light),
            },
            ClosedForm {
                name: concat!($name, ", weighed"),
                formula: $formula,
                truth: $truth,
                few: $few,
                scene: |world| lit(world, LightSampling::Weighed, $light),
            },
        )+]
    };
}

pub(super) const FORMS: &[ClosedForm] = found_in_three_ways![
    "ball light overhead", "L (r / h)²", || 0.25, 1 << 16, |world| {
        world.spawn((Sphere { radius: 0.5 }, Placement::at(0.0, 1.0, 0.0), shining()));
    };
    "disk light overhead", "L r² / (r² + h²)", || 0.5, 1 << 15, |world| {
        world.spawn((Disk { radius: 1.0 }, Placement::at(0.0, 1.0, 0.0), shining()));
    };
    "square light overhead", "(4/π) (a/√(1+a²)) atan(a/√(1+a²)) L", square, 1 << 15, |world| {
        world.spawn((Rectangle { width: 2.0, depth: 2.0 }, Placement::at(0.0, 1.0, 0.0), shining()));
    };
];

/// Four corners of a square of half side 1 at height 1, each by Lambert's formula for a rectangle above its corner.
fn square() -> f64 {
    let b = 1.0 / 2.0_f64.sqrt();
    4.0 / std::f64::consts::PI * b * libm::atan(b)
}

fn shining() -> Emissive {
    Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() }
}

fn lit(world: &mut World, lights: LightSampling, light: fn(&mut World)) {
    look_down(world, 0.1, Integrator::Path { legs: 2, lights, roulette: 0 });
    world.spawn((Plane::default(), Matte { colour: Rgb::grey(1.0) }));
    light(world);
}

/// A camera that sees only the origin, from so high above.
pub(super) fn look_down(world: &mut World, height: f64, integrator: Integrator) {
    let look = LookAt { eye: DVec3::new(0.0, height, 0.0), target: DVec3::ZERO, up: DVec3::Z };
    world.spawn((OrthographicCamera { view_height: 1e-6 }, look, integrator));
}
