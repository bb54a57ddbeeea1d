//! What lights a room whose lamp is behind a keyhole? Paths from the eye hardly ever get there, and paths from the lamp do.
//! A dark room; a lamp in the closet next door; between them a wall with a small hole.
//! New here: bidirectional path tracing, paths from both ends, joined vertex to vertex.

use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use pinhole::scene::*;
use pinhole::{Chapter, stages};
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("39_both_ends", "light from both ends", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::direct_light())
        .offer(stages::lights())
        .offer(stages::area_lights())
        .offer(stages::mis())
        .offer(stages::bounces())
        .offer(stages::path_continuation())
        .offer(stages::light_tracing())
        .offer(stages::bidirectional_path_tracing())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(64.0), axis: FovAxis::Vertical },
        LookAt { eye: [1.75, 1.7, 1.75].into(), target: [-0.9, 0.95, -0.9].into(), ..LookAt::default() },
        Sampling { samples: 32, seed: 39, ..Sampling::default() },
        Integrator::Path { max_depth: 10, lights: LightStrategy::Mis, roulette: 5 },
        BidirectionalPathTracing::default(),
    ));
    let mut wall = |name: &'static str, size: [f64; 3], [x, y, z]: [f64; 3], colour: Rgb| {
        world.spawn((Name::new(name), Cuboid { size: size.into() }, Placement::at(x, y, z), Matte { colour }));
    };

    // The room is 4 wide, 3 high and 4 deep; the closet behind its wall on the right is as deep and as high.
    let (white, red) = (Rgb::grey(0.7), Rgb::new(0.6, 0.36, 0.26));
    wall("floor", [7.0, 0.2, 4.4], [1.5, -0.1, 0.0], Rgb::new(0.5, 0.4, 0.3));
    wall("ceiling", [7.0, 0.2, 4.4], [1.5, 3.1, 0.0], white);
    wall("back wall", [7.0, 3.0, 0.2], [1.5, 1.5, -2.1], white);
    wall("front wall", [7.0, 3.0, 0.2], [1.5, 1.5, 2.1], white);
    wall("left wall", [0.2, 3.0, 4.4], [-2.1, 1.5, 0.0], red);
    wall("closet's wall", [0.2, 3.0, 4.4], [5.1, 1.5, 0.0], white);

    // The wall between them is four pieces, which leave a hole of 0.2 by 0.2.
    wall("below the keyhole", [0.2, 1.4, 4.4], [2.1, 0.7, 0.0], white);
    wall("above the keyhole", [0.2, 1.4, 4.4], [2.1, 2.3, 0.0], white);
    wall("behind the keyhole", [0.2, 0.2, 1.9], [2.1, 1.5, -1.05], white);
    wall("before the keyhole", [0.2, 0.2, 1.9], [2.1, 1.5, 1.05], white);

    wall("crate", [0.9, 0.9, 0.9], [-1.2, 0.45, -1.2], Rgb::new(0.3, 0.42, 0.6));
    let ball = (Sphere { radius: 0.45 }, Placement::at(0.35, 0.45, -0.9), Matte { colour: white });
    world.spawn((Name::new("ball"), ball));

    // The lamp faces the keyhole.
    let turned = DQuat::from_rotation_arc(DVec3::Y, DVec3::NEG_X);
    let place = Placement { orientation: turned, ..Placement::at(2.5, 1.5, 0.0) };
    let emissive = Emissive { radiance: Rgb::new(2000.0, 1900.0, 1700.0), sides: Sides::Front };
    world.spawn((Name::new("lamp"), Rectangle { width: 0.3, depth: 0.3 }, place, emissive));
}
// ANCHOR_END: scene
