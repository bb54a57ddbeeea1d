//! How much of the light that leaves one surface arrives at another: form factors.

use super::receiver::look_at_ground;
use super::{ClosedForm, GREEN};
use bevy_ecs::prelude::*;
use pinhole::scene::{DQuat, Disk, Emissive, Integrator, LightStrategy, Matte, Placement, Plane, Rectangle, Rgb};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4, PI};

pub(super) const FORMS: &[ClosedForm] = &[
    ClosedForm {
        name: "form factor of squares face to face",
        formula: "(2/π) (ln(2/√3) + 2√2 atan(1/√2) − π/2)",
        truth: || {
            let atan = libm::atan(FRAC_1_SQRT_2);
            2.0 / PI * (libm::log(2.0 / 3.0_f64.sqrt()) + 2.0 * 2.0_f64.sqrt() * atan - 0.5 * PI)
        },
        few: 1 << 14,
        component: GREEN,
        scene: |world| {
            ground(world, 1.0);
            world.spawn((Rectangle { width: 1.0, depth: 1.0 }, Placement::at(0.0, 1.0, 0.0), shining()));
        },
    },
    ClosedForm {
        name: "form factor of squares with one edge",
        formula: "1/2 − (√2 atan(1/√2) + ln(4/3) / 4) / π",
        truth: || {
            let atan = libm::atan(FRAC_1_SQRT_2);
            0.5 - (2.0_f64.sqrt() * atan + 0.25 * libm::log(4.0 / 3.0)) / PI
        },
        few: 1 << 15,
        component: GREEN,
        scene: |world| {
            ground(world, 1.0);
            let orientation = DQuat::from_xyzw(0.0, 0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2);
            let place = Placement { orientation, ..Placement::at(0.5, 0.5, 0.0) };
            world.spawn((Rectangle { width: 1.0, depth: 1.0 }, place, shining()));
        },
    },
    ClosedForm {
        name: "form factor of disks face to face",
        formula: "(π/4) (3 − √5) / 2",
        // The disk fills π/4 of the view.
        truth: || FRAC_PI_4 * 0.5 * (3.0 - 5.0_f64.sqrt()),
        few: 1 << 15,
        component: GREEN,
        scene: |world| {
            look_at_ground(world, 0.5, 2.0, MIS);
            world.spawn((Disk { radius: 1.0 }, Matte { colour: Rgb::grey(1.0) }));
            world.spawn((Disk { radius: 1.0 }, Placement::at(0.0, 1.0, 0.0), shining()));
        },
    },
];

const MIS: Integrator = Integrator::Path { max_depth: 2, lights: LightStrategy::Mis, roulette: 0 };

/// White ground, seen over a square of this side about the origin from half a unit above.
fn ground(world: &mut World, side: f64) {
    look_at_ground(world, 0.5, side, MIS);
    world.spawn((Plane::default(), Matte { colour: Rgb::grey(1.0) }));
}

fn shining() -> Emissive {
    Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() }
}
