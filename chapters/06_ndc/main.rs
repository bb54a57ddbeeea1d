//! A place in the image, free of the image's size: from 0 to 1 in both directions, whatever the resolution.
//! The picture shows it: red grows from 0 to 1 to the right, green from 0 to 1 downward.
//! New here: the first step out of the box of ray generation, from raster to NDC.

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
    Chapter::new("06_ndc", "points free of the image's size", scene)
        .offer(rays::raster_stage())
        .offer(rays::ndc_stage())
        .show::<rays::NdcPoints>()
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((Name::new("camera"), PerspectiveCamera::default(), Resolution { width: 480, height: 240 }));
}
// ANCHOR_END: scene
