//! How wrong is a picture, and after how long? A scene whose error is at its edges: of balls, and of their shadows.
//! Two lights, so that a shadow has an edge inside another.
//! New here: no stage at all, but a report about those there are.

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
    Chapter::new("18_error_and_time", "how wrong, after how long", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
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
        Sampling::default(),
    ));
    for (name, radius, x, z, colour) in [
        ("near ball", 0.8, -1.9, 1.0, Rgb::new(0.85, 0.35, 0.2)),
        ("middle ball", 0.8, 0.2, -0.5, Rgb::new(0.9, 0.75, 0.3)),
        ("far ball", 0.8, 2.3, -2.0, Rgb::new(0.25, 0.5, 0.75)),
        ("left pebble", 0.15, -0.6, 1.6, Rgb::grey(0.8)),
        ("middle pebble", 0.15, 0.1, 1.5, Rgb::grey(0.8)),
        ("right pebble", 0.15, 0.8, 1.4, Rgb::grey(0.8)),
    ] {
        world.spawn((Name::new(name), Sphere { radius }, Placement::at(x, radius, z), Matte { colour }));
    }
    world.spawn((Name::new("ground"), Plane::default(), Matte { colour: Rgb::grey(0.6) }));
    for (name, place, intensity) in [
        ("warm lamp", Placement::at(2.5, 5.0, 3.0), Rgb::new(80.0, 66.0, 50.0)),
        ("cool lamp", Placement::at(-3.5, 4.0, 2.0), Rgb::new(18.0, 26.0, 38.0)),
    ] {
        world.spawn((Name::new(name), PointLight { intensity, ..PointLight::default() }, place));
    }
    world.spawn((Name::new("night"), Background { colour: Rgb::new(0.008, 0.012, 0.02) }));
}
// ANCHOR_END: scene
