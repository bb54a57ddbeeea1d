//! The screen: the image with its centre at the origin, y up, and as much wider than high as it has pixels.
//! The picture shows it: red grows to the right, green upward, and the middle has half of each.
//! New here: from NDC to the screen, with the aspect and the two signs.

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
    Chapter::new("07_screen", "points as the camera sees them", scene)
        .offer(rays::raster_stage())
        .offer(rays::ndc_stage())
        .offer(rays::screen_stage())
        .show::<rays::ScreenPoints>()
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(40.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 1.5, 6.0].into(), target: [0.0, 1.5, 0.0].into(), ..LookAt::default() },
        Resolution { width: 400, height: 200 },
    ));
    for (name, radius, at, colour) in [
        ("large ball", 1.0, Placement::at(-0.9, 1.0, 0.0), Rgb::new(0.85, 0.35, 0.2)),
        ("small ball", 0.4, Placement::at(1.3, 2.7, -0.4), Rgb::new(0.9, 0.75, 0.3)),
    ] {
        world.spawn((Name::new(name), Sphere { radius }, at, Matte { colour }));
    }
    world.spawn((Name::new("ground"), Plane::default(), Matte { colour: Rgb::grey(0.6) }));
    let light = PointLight { intensity: Rgb::grey(15_000.0), ..PointLight::default() };
    world.spawn((Name::new("distant lamp"), light, Placement::at(-35.0, 50.0, 40.0)));
    world.spawn((Name::new("sky"), Background { colour: Rgb::new(0.16, 0.28, 0.45) }));
}
// ANCHOR_END: scene
