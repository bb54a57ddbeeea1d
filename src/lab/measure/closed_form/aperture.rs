//! The circle of confusion: over what a lens spreads one point of the picture, where it is not in focus.

use super::{ClosedForm, GREEN};
use bevy_ecs::prelude::*;
use pinhole::scene::{
    Aperture, DQuat, Degrees, Disk, Emissive, Lens, PerspectiveCamera, Placement, Rectangle, Rgb, Sphere,
};
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// The focus of all of them.
const FOCUS: f64 = 4.0;

pub(super) const FORMS: &[ClosedForm] = &[
    ClosedForm {
        name: "a coin in the circle of confusion, behind",
        formula: "(ρ / c)², c = R (z / f − 1)",
        truth: || squared(0.3 / 0.5),
        few: 1 << 15,
        component: GREEN,
        scene: |world| {
            open(world, Aperture::Radius { radius: 0.5 }, 0);
            coin(world, 0.3, 8.0);
        },
    },
    ClosedForm {
        name: "a coin in the circle of confusion, before",
        formula: "(ρ / c)², c = R (1 − z / f)",
        truth: || squared(0.25 / 0.375),
        few: 1 << 15,
        component: GREEN,
        scene: |world| {
            open(world, Aperture::Radius { radius: 0.5 }, 0);
            coin(world, 0.25, 1.0);
        },
    },
    ClosedForm {
        name: "a coin in the circle of confusion at f/2",
        formula: "(ρ / c)², c = (F / 2N) (z / f − 1)",
        truth: || squared(0.35 / 0.5),
        few: 1 << 15,
        component: GREEN,
        scene: |world| {
            open(world, Aperture::FNumber { number: 2.0, focal_length: 1.0 }, 0);
            coin(world, 0.35, 12.0);
        },
    },
    ClosedForm {
        name: "a coin in a hexagon of confusion",
        formula: "2π ρ² / (3√3 c²)",
        truth: || 2.0 * PI / (3.0 * 3.0_f64.sqrt()) * squared(0.3 / 0.5),
        few: 1 << 15,
        component: GREEN,
        scene: |world| {
            open(world, Aperture::Radius { radius: 0.5 }, 6);
            coin(world, 0.3, 8.0);
        },
    },
    ClosedForm {
        name: "an edge half way out in the circle",
        formula: "1/3 − √3 / 4π",
        truth: || 1.0 / 3.0 - 3.0_f64.sqrt() / (4.0 * PI),
        few: 1 << 16,
        component: GREEN,
        scene: |world| {
            open(world, Aperture::Radius { radius: 0.5 }, 0);
            let sheet = Rectangle { width: 10.0, depth: 10.0 };
            world.spawn((sheet, Placement { position: [5.25, 0.0, -8.0].into(), ..facing() }, shining()));
        },
    },
    ClosedForm {
        name: "a tiny ball in focus",
        formula: "1",
        truth: || 1.0,
        few: 1 << 11,
        component: GREEN,
        scene: |world| {
            open(world, Aperture::Radius { radius: 0.5 }, 0);
            world.spawn((Sphere { radius: 0.01 }, Placement::at(0.0, 0.0, -FOCUS), shining()));
        },
    },
];

fn squared(ratio: f64) -> f64 {
    ratio * ratio
}

/// A camera that looks at one point of the plane in focus, through all of its lens.
fn open(world: &mut World, aperture: Aperture, blades: u32) {
    let lens = Lens { aperture, focus_distance: FOCUS, blades, ..Lens::default() };
    world.spawn((PerspectiveCamera { fov: Degrees(0.02), ..PerspectiveCamera::default() }, lens));
}

fn coin(world: &mut World, radius: f64, depth: f64) {
    world.spawn((Disk { radius }, Placement { position: [0.0, 0.0, -depth].into(), ..facing() }, shining()));
}

/// Turned so that a disk or rectangle faces the camera.
fn facing() -> Placement {
    Placement { orientation: DQuat::from_xyzw(FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2), ..Placement::default() }
}

fn shining() -> Emissive {
    Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() }
}
