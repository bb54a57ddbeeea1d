//! How long something covers what the camera sees, while the shutter is open from 0 to 1.

use super::{ClosedForm, GREEN};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::{DQuat, Disk, Emissive, Motion, OrthographicCamera, Placement, Rectangle, Rgb, Shutter, Sphere};
use std::f64::consts::FRAC_1_SQRT_2;

pub(super) const FORMS: &[ClosedForm] = &[
    ClosedForm {
        name: "a mat passes a point",
        formula: "width / (v T)",
        truth: || 0.25,
        few: 1 << 16,
        component: GREEN,
        scene: |world| {
            point(world);
            world.spawn((mat(0.5), facing([-1.0, 0.0]), shining(), going(2.0)));
        },
    },
    ClosedForm {
        name: "an edge comes to a point and stays",
        formula: "1 − distance / (v T)",
        truth: || 0.65,
        few: 1 << 15,
        component: GREEN,
        scene: |world| {
            point(world);
            world.spawn((mat(4.0), facing([-2.35, 0.0]), shining(), going(1.0)));
        },
    },
    ClosedForm {
        name: "an edge moves within a pixel",
        formula: "(covered at first + at last) / 2",
        truth: || 0.6,
        few: 1 << 15,
        component: GREEN,
        scene: |world| {
            // The whole image is the pixel, from −0.5 to 0.5; the edge goes from −0.3 to 0.5.
            camera(world, 1.0);
            world.spawn((mat(4.0), facing([-2.3, 0.0]), shining(), going(0.8)));
        },
    },
    ClosedForm {
        name: "a ball passes above a point",
        formula: "2 √(r² − h²) / (v T)",
        truth: || 0.4,
        few: 1 << 15,
        component: GREEN,
        scene: |world| {
            point(world);
            world.spawn((Sphere { radius: 0.5 }, Placement::at(-1.0, 0.3, 0.0), shining(), going(2.0)));
        },
    },
    ClosedForm {
        name: "the camera passes a coin",
        formula: "2 r / (v T)",
        truth: || 0.3,
        few: 1 << 16,
        component: GREEN,
        scene: |world| {
            let eye = (OrthographicCamera { view_height: 1e-6 }, Placement::at(-1.0, 0.0, 9.0));
            world.spawn((eye, Shutter::default(), going(2.0)));
            world.spawn((Disk { radius: 0.3 }, facing([0.0, 0.0]), shining()));
        },
    },
];

/// A camera that sees one point.
fn point(world: &mut World) {
    camera(world, 1e-6);
}

fn camera(world: &mut World, view_height: f64) {
    world.spawn((OrthographicCamera { view_height }, Placement::at(0.0, 0.0, 9.0), Shutter::default()));
}

fn mat(width: f64) -> Rectangle {
    Rectangle { width, depth: 4.0 }
}

fn going(speed: f64) -> Motion {
    Motion { velocity: speed * DVec3::X }
}

/// At a place in the plane z = 0, turned so that a disk or rectangle faces the camera.
fn facing([x, y]: [f64; 2]) -> Placement {
    let orientation = DQuat::from_xyzw(FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2);
    Placement { orientation, ..Placement::at(x, y, 0.0) }
}

fn shining() -> Emissive {
    Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() }
}
