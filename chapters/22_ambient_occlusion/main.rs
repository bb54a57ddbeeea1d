//! How much of the sky does each point see? A courtyard under an even sky: creases, corners and arcades are dark.
//! All is of one colour; whatever tells the shapes apart is what hides the sky.
//! New here: the `Integrator` on the camera, and rays to the sky instead of to lights.

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
    Chapter::new("22_ambient_occlusion", "ambient occlusion", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::direct_light())
        .offer(stages::ambient_occlusion())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(38.0), axis: FovAxis::Vertical },
        LookAt { eye: [3.4, 2.7, 5.2].into(), target: [-0.1, 0.85, -0.4].into(), ..LookAt::default() },
        Sampling { samples: 64, seed: 22, ..Sampling::default() },
        Integrator::AmbientOcclusion { distance: f64::INFINITY },
    ));
    world.spawn((Name::new("ground"), Plane::default(), Matte::default()));
    let mut block = |name: &'static str, size: [f64; 3], [x, y, z]: [f64; 3]| {
        world.spawn((Name::new(name), Cuboid { size: size.into() }, Placement::at(x, y, z), Matte::default()));
    };
    block("back wall", [6.4, 2.6, 0.3], [0.0, 1.3, -2.6]);
    block("side wall", [0.3, 2.6, 5.0], [-3.05, 1.3, -0.25]);
    for (name, x) in [("pillar 1", -2.2), ("pillar 2", -0.6), ("pillar 3", 1.0), ("pillar 4", 2.6)] {
        block(name, [0.4, 1.83, 0.4], [x, 0.915, -1.3]);
    }
    block("beam", [5.6, 0.35, 0.5], [0.2, 2.0, -1.3]);
    block("roof", [5.6, 0.12, 1.6], [0.2, 2.23, -1.9]);
    block("lower step", [1.8, 0.25, 1.8], [0.9, 0.125, 1.2]);
    block("upper step", [1.3, 0.25, 1.3], [0.9, 0.375, 1.2]);
    for (name, radius, [x, y, z]) in [
        ("ball on the steps", 0.5, [0.9, 1.0, 1.2]),
        ("ball in the corner", 0.45, [-2.1, 0.45, 0.3]),
        ("small ball", 0.25, [-1.5, 0.25, 0.95]),
        ("hovering ball", 0.3, [-0.9, 0.55, 1.9]),
    ] {
        world.spawn((Name::new(name), Sphere { radius }, Placement::at(x, y, z), Matte::default()));
    }
}
// ANCHOR_END: scene
