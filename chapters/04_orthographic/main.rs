//! A rectangle stands in the scene with a square grid on it, and through each square goes a ray, straight ahead.
//! What a ray hits gives the pixel its colour; a ray that misses leaves the default colour.
//! New here: the orthographic camera. Its rays are parallel, so all three balls, equally large, look equally large.

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
    Chapter::new("04_orthographic", "the rectangle with a grid", scene)
        .offer(stages::camera_rays())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::unlit())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        OrthographicCamera { view_height: 4.0 },
        LookAt { eye: [0.0, 2.6, 6.0].into(), target: [0.0, 0.8, 0.0].into(), ..LookAt::default() },
    ));
    for (name, x, z, colour) in [
        ("near ball", -1.9, 1.0, Rgb::new(0.85, 0.35, 0.2)),
        ("middle ball", 0.2, -0.5, Rgb::new(0.9, 0.75, 0.3)),
        ("far ball", 2.3, -2.0, Rgb::new(0.25, 0.5, 0.75)),
    ] {
        world.spawn((Name::new(name), Sphere { radius: 0.8 }, Placement::at(x, 0.8, z), Matte { colour }));
    }
    world.spawn((Name::new("default colour"), Background { colour: Rgb::new(0.45, 0.6, 0.8) }));
}
// ANCHOR_END: scene
