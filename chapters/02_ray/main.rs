//! A ray is a point and a direction: r(t) = O + tR, with R of length 1.
//! The picture paints R for every pixel: x as red, y as green, z as blue, each from −1 to 1.
//! New here: ray generation, as a closed box that later chapters open.

use bevy_ecs::prelude::*;
use pinhole::scene::*;
use pinhole::{Chapter, rays, stages};
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("02_ray", "a ray: r(t) = O + tR", scene).offer(stages::camera_rays()).show::<rays::WorldRays>()
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(75.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 1.0, 4.0].into(), target: [0.0, 1.0, 0.0].into(), ..LookAt::default() },
    ));
    let red = Matte { colour: Rgb::new(0.85, 0.3, 0.2) };
    world.spawn((Name::new("ball"), Sphere { radius: 1.0 }, Placement::at(0.0, 1.0, 0.0), red));
}
// ANCHOR_END: scene
