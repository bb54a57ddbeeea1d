//! The camera stands anywhere and looks in any direction; its rays were made as if it stood at the origin, facing −z.
//! Eggs and a lens are spheres whose placement scales them unevenly; a point, a direction and a normal move differently.
//! New here: the last step of ray generation, and where things stand.

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
    Chapter::new("09_camera_to_world", "the camera stands anywhere", scene)
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::transforms())
        .offer(stages::direct_light())
        .offer(rays::raster_stage())
        .offer(rays::ndc_stage())
        .offer(rays::screen_stage())
        .offer(rays::perspective_stage())
        .offer(rays::world_stage())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    let look = LookAt { eye: [3.0, 2.6, 4.5].into(), target: [0.0, 0.7, 0.0].into(), up: [0.3, 1.0, 0.0].into() };
    world.spawn((Name::new("camera"), PerspectiveCamera { fov: Degrees(40.0), axis: FovAxis::Vertical }, look));
    let leaning = DQuat::from_xyzw(0.0, 0.0, 0.28, 0.96);
    for (name, scale, orientation, [x, y, z], colour) in [
        ("egg", [0.7, 1.0, 0.7], DQuat::IDENTITY, [-1.5, 1.0, 0.2], Rgb::new(0.8, 0.65, 0.5)),
        ("lens", [0.4, 1.1, 1.1], leaning, [0.3, 1.1, -0.3], Rgb::new(0.45, 0.65, 0.75)),
        ("ball", [0.5, 0.5, 0.5], DQuat::IDENTITY, [1.2, 0.5, 1.0], Rgb::new(0.85, 0.35, 0.2)),
    ] {
        let placement = Placement { position: [x, y, z].into(), orientation, scale: scale.into() };
        world.spawn((Name::new(name), Sphere { radius: 1.0 }, placement, Matte { colour }));
    }
    world.spawn((Name::new("ground"), Plane::default(), Matte { colour: Rgb::grey(0.6) }));
    let light = PointLight { intensity: Rgb::grey(80.0), ..PointLight::default() };
    world.spawn((Name::new("lamp"), light, Placement::at(0.8, 5.0, 4.0)));
    world.spawn((Name::new("night"), Background { colour: Rgb::new(0.008, 0.012, 0.02) }));
}
// ANCHOR_END: scene
