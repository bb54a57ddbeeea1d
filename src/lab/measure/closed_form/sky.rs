//! How much of the sky a point of the ground sees past a wall, and past a ball.

use super::receiver::look_at_point;
use super::{ClosedForm, GREEN};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::{DQuat, Integrator, Matte, Placement, Plane, Rectangle, Sphere};

pub(super) const FORMS: &[ClosedForm] = &[
    ClosedForm {
        name: "sky over open ground",
        formula: "1",
        truth: || 1.0,
        few: 1 << 12,
        component: GREEN,
        scene: ground,
    },
    ClosedForm {
        name: "sky beside an endless wall",
        formula: "1/2",
        truth: || 0.5,
        few: 1 << 15,
        component: GREEN,
        scene: |world| {
            ground(world);
            let wall = Plane { normal: DVec3::NEG_X };
            world.spawn((wall, Placement::at(3.0, 0.0, 0.0), Matte::default()));
        },
    },
    ClosedForm {
        name: "sky beside a wall as high as it is far",
        formula: "1 − (1 − cos 45°) / 2",
        truth: || 0.5 + 0.5 * std::f64::consts::FRAC_1_SQRT_2,
        few: 1 << 15,
        component: GREEN,
        scene: |world| {
            ground(world);
            let half = std::f64::consts::FRAC_1_SQRT_2;
            let orientation = DQuat::from_xyzw(0.0, 0.0, half, half);
            let place = Placement { position: DVec3::new(1.0, 0.0, 0.0), orientation, ..Placement::default() };
            world.spawn((Rectangle { width: 2.0, depth: 2e5 }, place, Matte::default()));
        },
    },
    ClosedForm {
        name: "sky past a ball overhead",
        formula: "1 − (r / h)²",
        truth: || 1.0 - 0.64,
        few: 1 << 15,
        component: GREEN,
        scene: |world| {
            ground(world);
            world.spawn((Sphere { radius: 0.8 }, Placement::at(0.0, 1.0, 0.0), Matte::default()));
        },
    },
];

fn ground(world: &mut World) {
    look_at_point(world, 0.1, Integrator::AmbientOcclusion { distance: f64::INFINITY });
    world.spawn((Plane::default(), Matte::default()));
}
