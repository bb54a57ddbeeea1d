//! Does the light reach the point that a ray has hit? Another ray, from the point to the light, asks what is in between.
//! Two lights of different colours: where one is hidden, the other colours the shadow.
//! New here: shadow rays, stage by stage; the box that chapter 5 left closed.

use bevy_ecs::prelude::*;
use pinhole::scene::*;
use pinhole::{Chapter, follow, shade, stages};
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("10_light_and_shadow", "does light get there", scene)
        .offer(stages::camera_rays())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(shade::start_stage())
        .offer(shade::background_stage())
        .offer(shade::start_shadow_rays_stage())
        .offer(shade::point_light_stage())
        .offer(shade::start_shadow_stage())
        .offer(shade::sphere_shadow_stage())
        .offer(shade::plane_shadow_stage())
        .offer(follow::matte_direct_light_stage())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(36.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 1.8, 6.0].into(), target: [0.0, 0.75, 0.0].into(), ..LookAt::default() },
    ));
    for (name, radius, place, grey) in [
        ("large ball", 1.0, Placement::at(-0.3, 1.025, 0.0), 0.75),
        ("small ball", 0.35, Placement::at(1.3, 0.15625, 0.9), 0.7),
        ("pebble", 0.2, Placement::at(-1.45, 2.175, 1.0), 0.7),
    ] {
        world.spawn((Name::new(name), Sphere { radius }, place, Matte { colour: Rgb::grey(grey) }));
    }
    let slope = Plane { normal: [0.0, 40.0, 9.0].into() };
    world.spawn((Name::new("slope"), slope, Matte { colour: Rgb::grey(0.6) }));
    for (name, place, intensity) in [
        ("warm lamp", Placement::at(-4.0, 4.6, 3.4), Rgb::new(105.0, 68.0, 34.0)),
        ("cool lamp", Placement::at(3.6, 3.6, 2.4), Rgb::new(16.0, 30.0, 54.0)),
    ] {
        world.spawn((Name::new(name), PointLight { intensity, ..PointLight::default() }, place));
    }
}
// ANCHOR_END: scene
