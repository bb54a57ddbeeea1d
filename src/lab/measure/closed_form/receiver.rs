//! What a point of the ground receives of lights that have an area; a matte ground of albedo 1 sends on E / π.

use super::{ClosedForm, GREEN};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::{
    Disk, Emissive, Integrator, LightStrategy, LookAt, Matte, OrthographicCamera, Placement, Plane, Rectangle, Rgb,
    Sphere, Triangle,
};

/// A light by the three strategies that find it.
macro_rules! by_three_strategies {
    ($($name:literal, $formula:literal, $truth:expr, $few:expr, $light:expr;)+) => {
        &[$(
            ClosedForm {
                name: concat!($name, ", BSDF sampling"),
                formula: $formula,
                truth: $truth,
                few: $few,
                component: GREEN,
                scene: |world| lit(world, LightStrategy::Bsdf, $light),
            },
            ClosedForm {
                name: concat!($name, ", light sampling"),
                formula: $formula,
                truth: $truth,
                few: $few,
                component: GREEN,
                scene: |world| lit(world, LightStrategy::Light, $light),
            },
            ClosedForm {
                name: concat!($name, ", MIS"),
                formula: $formula,
                truth: $truth,
                few: $few,
                component: GREEN,
                scene: |world| lit(world, LightStrategy::Mis, $light),
            },
        )+]
    };
}

pub(super) const LIGHTS: &[ClosedForm] = by_three_strategies![
    "ball light overhead", "L (r / h)²", || 0.25, 1 << 16, |world| {
        world.spawn((Sphere { radius: 0.5 }, Placement::at(0.0, 1.0, 0.0), shining()));
    };
    "disk light overhead", "L r² / (r² + h²)", || 0.5, 1 << 15, |world| {
        world.spawn((Disk { radius: 1.0 }, Placement::at(0.0, 1.0, 0.0), shining()));
    };
    "square light overhead", "(4/π) (a/√(1+a²)) atan(a/√(1+a²)) L", || square(1.0), 1 << 15, |world| {
        world.spawn((Rectangle { width: 2.0, depth: 2.0 }, Placement::at(0.0, 1.0, 0.0), shining()));
    };
    "pentagon of triangles", "Σ angle · lean of each edge / 2π", pentagon, 1 << 15, |world| {
        let [first, rest @ ..] = PENTAGON.map(DVec3::from);
        for pair in rest.windows(2) {
            world.spawn((Triangle { vertices: [first, pair[0], pair[1]], ..Triangle::default() }, shining()));
        }
    };
];

/// From nearer than this, lights are sampled by the solid angle that they subtend.
pub(super) const FAR_LIGHTS: &[ClosedForm] = &[
    ClosedForm {
        name: "small square light, light sampling by area",
        formula: "(4/π) (a/√(1+a²)) atan(a/√(1+a²)) L",
        truth: || square(0.1),
        few: 1 << 11,
        component: GREEN,
        scene: |world| {
            lit(world, LightStrategy::Light, |world| {
                world.spawn((Rectangle { width: 0.2, depth: 0.2 }, Placement::at(0.0, 1.0, 0.0), shining()));
            });
        },
    },
    ClosedForm {
        name: "small disk light, light sampling by area",
        formula: "L r² / (r² + h²)",
        truth: || 0.01 / 1.01,
        few: 1 << 11,
        component: GREEN,
        scene: |world| {
            lit(world, LightStrategy::Light, |world| {
                world.spawn((Disk { radius: 0.1 }, Placement::at(0.0, 1.0, 0.0), shining()));
            });
        },
    },
];

/// A light's corners, not evenly about the zenith.
const PENTAGON: [[f64; 3]; 5] =
    [[-1.0, 1.0, -0.6], [0.2, 1.0, -1.0], [1.0, 1.0, 0.1], [0.4, 1.0, 0.9], [-0.7, 1.0, 0.8]];

/// The angle that each edge fills, times how far the plane through it and the point leans from the ground (Lambert 1760).
fn pentagon() -> f64 {
    let corners = PENTAGON.map(|corner| DVec3::from(corner).normalize());
    let mut sum = 0.0;
    for (i, &corner) in corners.iter().enumerate() {
        let next = corners[(i + 1) % corners.len()];
        let cross = corner.cross(next);
        sum += libm::atan2(cross.length(), corner.dot(next)) * cross.normalize().y;
    }
    (sum / (2.0 * std::f64::consts::PI)).abs()
}

/// Four corners of a square of this half side at height 1, each by Lambert's formula for a rectangle above its corner.
fn square(half: f64) -> f64 {
    let b = half / (1.0 + half * half).sqrt();
    4.0 / std::f64::consts::PI * b * libm::atan(b)
}

fn shining() -> Emissive {
    Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() }
}

fn lit(world: &mut World, lights: LightStrategy, light: fn(&mut World)) {
    look_at_point(world, 0.1, Integrator::Path { max_depth: 2, lights, roulette: 0 });
    world.spawn((Plane::default(), Matte { colour: Rgb::grey(1.0) }));
    light(world);
}

/// A camera that sees only the origin, from so high above.
pub(super) fn look_at_point(world: &mut World, height: f64, integrator: Integrator) {
    look_at_ground(world, height, 1e-6, integrator);
}

/// A camera that sees the square of this side about the origin, from so high above.
pub(super) fn look_at_ground(world: &mut World, height: f64, side: f64, integrator: Integrator) {
    let look = LookAt { eye: DVec3::new(0.0, height, 0.0), target: DVec3::ZERO, up: DVec3::Z };
    world.spawn((OrthographicCamera { view_height: side }, look, integrator));
}
