//! Where does the light come from that no light sends there directly? A room with one light below its ceiling.
//! The walls' colours lie on the ball, the block and the ceiling.
//! New here: surfaces reflect light to each other, until Russian roulette ends a path.

use bevy_ecs::prelude::*;
use pinhole::scene::*;
use pinhole::{Chapter, stages};
use std::f64::consts::{FRAC_PI_2, PI};
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("25_path_tracing", "path tracing", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::direct_light())
        .offer(stages::area_lights())
        .offer(stages::mis())
        .offer(stages::bounces())
        .offer(stages::path_continuation())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(31.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 1.02, 4.6].into(), target: [0.0, 0.98, 0.0].into(), ..LookAt::default() },
        Sampling { samples: 64, seed: 25, ..Sampling::default() },
    ));
    let (white, orange, blue) = (Rgb::new(0.75, 0.73, 0.7), Rgb::new(0.7, 0.25, 0.1), Rgb::new(0.1, 0.35, 0.55));
    let mut board = |name: &'static str, width, [x, y, z]: [f64; 3], orientation, colour| {
        let place = Placement { orientation, ..Placement::at(x, y, z) };
        world.spawn((Name::new(name), Rectangle { width, depth: 2.0 }, place, Matte { colour }));
    };
    let (level, upright, sideways) =
        (DQuat::IDENTITY, DQuat::from_rotation_x(FRAC_PI_2), DQuat::from_rotation_z(FRAC_PI_2));
    board("floor", 3.2, [0.0, 0.0, 0.0], level, white);
    board("ceiling", 3.2, [0.0, 2.0, 0.0], level, white);
    board("back wall", 3.2, [0.0, 1.0, -1.0], upright, white);
    board("left wall", 2.0, [-1.6, 1.0, 0.0], sideways, orange);
    board("right wall", 2.0, [1.6, 1.0, 0.0], sideways, blue);

    let matte = |r, g, b| Matte { colour: Rgb::new(r, g, b) };
    world.spawn((Name::new("ball"), Sphere { radius: 0.45 }, Placement::at(-0.75, 0.45, -0.2), matte(0.8, 0.8, 0.8)));
    let gold = matte(0.8, 0.65, 0.2);
    world.spawn((Name::new("small ball"), Sphere { radius: 0.2 }, Placement::at(0.1, 0.2, 0.5), gold));
    let turned = Placement { orientation: DQuat::from_rotation_y(0.5), ..Placement::at(0.7, 0.55, -0.3) };
    world.spawn((Name::new("block"), Cuboid { size: [0.6, 1.1, 0.6].into() }, turned, matte(0.8, 0.8, 0.8)));

    // Its front looks down.
    let place = Placement { orientation: DQuat::from_rotation_x(PI), ..Placement::at(0.0, 1.99, 0.0) };
    let emissive = Emissive { radiance: Rgb::new(20.0, 18.0, 14.5), sides: Sides::Front };
    world.spawn((Name::new("lamp"), Rectangle { width: 0.8, depth: 0.5 }, place, emissive));
}
// ANCHOR_END: scene
