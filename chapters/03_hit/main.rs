//! Ray–sphere and ray–plane intersection: which t comes first?
//! The picture paints the hits, one colour for each shape, darker with distance.
//! New here: intersection, exact enough for a sphere that is very far or very large.

use bevy_ecs::prelude::*;
use pinhole::scene::*;
use pinhole::{Chapter, intersect, stages};
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("03_hit", "ray–sphere and ray–plane intersection", scene)
        .offer(stages::camera_rays())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .show::<intersect::Hits>()
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(45.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 1.5, 5.0].into(), target: [0.0, 0.9, 0.0].into(), ..LookAt::default() },
    ));
    let grey = Matte { colour: Rgb::grey(0.6) };
    world.spawn((Name::new("ball"), Sphere { radius: 1.0 }, Placement::at(-0.6, 1.0, 0.0), grey));
    world.spawn((Name::new("moon"), Sphere { radius: 40.0 }, Placement::at(120.0, 60.0, -400.0), grey));
    world.spawn((Name::new("ground"), Plane::default(), grey));
}
// ANCHOR_END: scene
