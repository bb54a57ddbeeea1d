//! An image is a grid of numbers.
//! The first picture shows where each pixel is: red grows to the right, green downward.
//! New here: a world, an entity, its components, and one system that fills a column.

use bevy_ecs::prelude::*;
use pinhole::scene::*;
use pinhole::{Chapter, rays};
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("01_image", "the image: a grid of numbers", scene)
        .offer(rays::raster_stage())
        .show::<rays::RasterPoints>()
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((Name::new("camera"), PerspectiveCamera::default(), Resolution { width: 480, height: 270 }));
}
// ANCHOR_END: scene
