//! How wide the camera sees: the tangent of half its angle is half the image plane's height at distance 1.
//! A larger angle shows more, and each thing smaller.
//! New here: from the screen to camera rays, with an angle measured across an axis of the image.

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
    Chapter::new("08_field_of_view", "how wide the camera sees", scene)
        .offer(rays::raster_stage())
        .offer(rays::ndc_stage())
        .offer(rays::screen_stage())
        .offer(rays::world_stage())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::direct_light())
        .offer(rays::perspective_stage())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(60.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 1.0, 4.0].into(), target: [0.0, 1.0, 0.0].into(), ..LookAt::default() },
    ));
    let (gold, blue) = (Matte { colour: Rgb::new(0.9, 0.7, 0.25) }, Matte { colour: Rgb::new(0.25, 0.45, 0.7) });
    world.spawn((Name::new("ball"), Sphere { radius: 1.0 }, Placement::at(0.0, 1.0, 0.0), gold));
    for z in [0.8, -2.2, -5.2, -8.2, -11.2] {
        for x in [-2.4, 2.4] {
            world.spawn((Name::new("post"), Sphere { radius: 0.6 }, Placement::at(x, 0.6, z), blue));
        }
    }
    world.spawn((Name::new("ground"), Plane::default(), Matte { colour: Rgb::grey(0.6) }));
    let light = PointLight { intensity: Rgb::grey(28_000.0), ..PointLight::default() };
    world.spawn((Name::new("distant lamp"), light, Placement::at(-40.0, 75.0, 50.0)));
    world.spawn((Name::new("sky"), Background { colour: Rgb::new(0.16, 0.28, 0.45) }));
}
// ANCHOR_END: scene
