//! The eye stands behind the grid: a pinhole camera.
//! Every ray starts at the eye and passes through the centre of a pixel, so what is farther away looks smaller.
//! New here: the perspective camera, and a light that a point of a surface sees or does not.

use bevy_ecs::prelude::*;
use pinhole::scene::*;
use pinhole::{Chapter, stages};
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("05_pinhole", "the eye behind the grid", scene)
        .offer(stages::camera_rays())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::direct_light())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(40.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 2.6, 6.0].into(), target: [0.0, 0.8, 0.0].into(), ..LookAt::default() },
    ));
    for (name, x, z, colour) in [
        ("near ball", -1.9, 1.0, Rgb::new(0.85, 0.35, 0.2)),
        ("middle ball", 0.2, -0.5, Rgb::new(0.9, 0.75, 0.3)),
        ("far ball", 2.3, -2.0, Rgb::new(0.25, 0.5, 0.75)),
    ] {
        world.spawn((Name::new(name), Sphere { radius: 0.8 }, Placement::at(x, 0.8, z), Matte { colour }));
    }
    world.spawn((Name::new("ground"), Plane::default(), Matte { colour: Rgb::grey(0.6) }));
    let light = PointLight { intensity: Rgb::grey(95.0), ..PointLight::default() };
    world.spawn((Name::new("lamp"), light, Placement::at(2.5, 5.0, 3.0)));
    world.spawn((Name::new("night"), Background { colour: Rgb::new(0.008, 0.012, 0.02) }));
}
// ANCHOR_END: scene
