//! Area lights: a shadow's edge is as soft as the light is wide. One point of one light is sampled at a time.
//! A wide light on one side, a bulb on the other: the post and the ball have a shadow of each.
//! New here: `Emissive` lights other surfaces; the stage "Sample area lights"; the camera's `Integrator`.

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
    Chapter::new("21_soft_shadows", "area lights", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::direct_light())
        .offer(stages::bounces())
        .offer(stages::area_lights())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(38.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 3.2, 6.0].into(), target: [0.0, 0.5, 0.2].into(), ..LookAt::default() },
        Sampling { samples: 64, seed: 21, sampler: Sampler::Sobol, filter: Filter::GAUSSIAN },
        Integrator::DISTRIBUTION,
    ));
    world.spawn((Name::new("floor"), Plane::default(), Matte { colour: Rgb::grey(0.6) }));
    let clay = Matte { colour: Rgb::new(0.7, 0.35, 0.2) };
    world.spawn((Name::new("ball"), Sphere { radius: 0.6 }, Placement::at(-1.2, 0.6, 0.1), clay));
    let size = [0.3, 1.5, 0.3].into();
    world.spawn((Name::new("post"), Cuboid { size }, Placement::at(0.8, 0.75, -0.1), Matte { colour: Rgb::grey(0.7) }));
    // Its own +y, where it shines, looks down at the floor before the things.
    let downward = DQuat::from_xyzw(0.502, 0.0, -0.754, 0.424).normalize();
    let behind = Placement { orientation: downward, ..Placement::at(-3.0, 3.0, -1.5) };
    let warm = Emissive { radiance: Rgb::new(34.0, 26.0, 17.0), sides: Sides::Front };
    world.spawn((Name::new("wide lamp"), Rectangle { width: 1.2, depth: 1.6 }, behind, warm));
    let cool = Emissive { radiance: Rgb::new(220.0, 300.0, 450.0), ..Emissive::default() };
    world.spawn((Name::new("bulb"), Sphere { radius: 0.12 }, Placement::at(2.3, 1.6, -1.7), cool));
}
// ANCHOR_END: scene
