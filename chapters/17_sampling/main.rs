//! Sampling a pixel: many rays through each, at well-chosen places, distributed as a filter says.
//! The rings become finer than a pixel; what is wrong with the samples shows as rings that are not there.
//! New here: the `Sampling` on the camera, and the stage "Place samples" in place of "Place raster points".

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
    Chapter::new("17_sampling", "sampling a pixel", scene)
        .offer(stages::camera_rays())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::direct_light())
        .offer(stages::samples())
}
// ANCHOR_END: chapter

// ANCHOR: scene
/// Rings around a mast: disks on one another, black and white in turns, each ring of the same area as the last.
const DISKS: u32 = 96;

fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(38.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 4.6, 6.6].into(), target: [0.0, -0.2, 0.2].into(), ..LookAt::default() },
        Sampling { samples: 16, seed: 17, sampler: Sampler::Sobol, filter: Filter::GAUSSIAN },
    ));
    for disk in 0..DISKS {
        let radius = 4.0 * (f64::from(DISKS - disk) / f64::from(DISKS)).sqrt();
        let colour = Rgb::grey(if disk % 2 == 0 { 0.02 } else { 0.9 });
        let placement = Placement::at(0.0, 0.001 * f64::from(disk), 0.0);
        world.spawn((Name::new(format!("disk {disk}")), Disk { radius }, placement, Matte { colour }));
    }
    let red = Matte { colour: Rgb::new(0.8, 0.15, 0.1) };
    world.spawn((Name::new("mast"), Sphere { radius: 0.25 }, Placement::at(0.0, 0.35, 0.0), red));
    world.spawn((Name::new("sky"), Background { colour: Rgb::new(0.25, 0.35, 0.5) }));
}
// ANCHOR_END: scene
