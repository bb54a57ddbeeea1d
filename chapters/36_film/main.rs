//! A film: values with keys, one picture for each frame, and a shutter that is open for part of it.
//! A ball flies through the keys of its path, a wheel turns beside it, and pearls mark where the ball is at every frame.
//! New here: `Keys` on anything; `--frames` renders what they change, and no stage knows of them.

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
    Chapter::new("36_film", "a film", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::textures())
        .offer(stages::direct_light())
        .offer(stages::lights())
        .offer(stages::motion())
}
// ANCHOR_END: chapter

// ANCHOR: path
/// The ball's keys: frames, and places there; the first and the last are outside the film.
const PATH: [(f64, [f64; 3]); 7] = [
    (-8.0, [-1.4, 1.9, -0.8]),
    (0.0, [-0.8, 1.6, 0.3]),
    (6.0, [-0.1, 0.4, 1.0]),
    (12.0, [0.7, 1.8, 0.5]),
    (32.0, [1.5, 0.4, 1.2]),
    (48.0, [2.7, 1.5, 0.2]),
    (56.0, [3.3, 1.6, -0.6]),
];
// ANCHOR_END: path

// ANCHOR: scene
fn scene(world: &mut World) {
    let eye = [(0.0, "(-0.8, 1.9, 7)"), (24.0, "(0.8, 1.5, 6)"), (48.0, "(2.2, 2.2, 6.6)")];
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(36.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.1, 1.7, 6.8].into(), target: [0.1, 1.0, 0.0].into(), ..LookAt::default() },
        Shutter { open: 0.0, close: 1.0 / 48.0 },
        Sampling { samples: 64, seed: 36, ..Sampling::default() },
        Keys::smooth().with("look_at.eye", eye),
    ));
    let matte = |r, g, b| Matte { colour: Rgb::new(r, g, b) };
    let text = |[x, y, z]: [f64; 3]| format!("({x:?}, {y:?}, {z:?})");
    let path = Keys::smooth().with("placement.position", PATH.map(|(frame, at)| (frame, text(at))));
    let ball = (Sphere { radius: 0.18 }, Placement { position: PATH[1].1.into(), ..Placement::default() });
    world.spawn((Name::new("ball"), ball, matte(0.85, 0.3, 0.15), path));
    for (frame, at) in &PATH[1..6] {
        let place = Placement { position: (*at).into(), ..Placement::default() };
        world.spawn((Name::new(format!("key {frame}")), Sphere { radius: 0.09 }, place, matte(0.9, 0.75, 0.2)));
    }
    for frame in (1..48).map(f64::from) {
        let next = PATH.iter().position(|(own, _)| *own > frame).unwrap_or(5);
        let four = [0, 1, 2, 3].map(|key| PATH[next + key - 2]);
        let along = |axis: usize| smooth(four.map(|(own, _)| own), four.map(|(_, at)| at[axis]), frame);
        let place = Placement::at(along(0), along(1), along(2));
        world.spawn((Name::new(format!("pearl {frame}")), Sphere { radius: 0.04 }, place, matte(0.95, 0.95, 0.95)));
    }
    let turns = [(0.0, "(0, 0, 0)"), (48.0, "(0, 0, 1980)")];
    let hub = (Name::new("wheel"), Placement::at(-2.2, 1.2, -0.6), Keys::default().with("placement.euler_xyz", turns));
    let hub = world.spawn(hub).id();
    let dark = matte(0.12, 0.2, 0.35);
    let lying = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2);
    let rim = (Torus { radius: 1.0, tube: 0.09 }, Placement { orientation: lying, ..Placement::default() });
    world.spawn((Name::new("rim"), rim, dark, ChildOf(hub)));
    for spoke in 0..4 {
        let turned = axis_angle([0.0, 0.0, 1.0].into(), Degrees(45.0 * f64::from(spoke)));
        let shape =
            (Cuboid { size: [1.9, 0.1, 0.1].into() }, Placement { orientation: turned, ..Placement::default() });
        world.spawn((Name::new(format!("spoke {spoke}")), shape, dark, ChildOf(hub)));
    }
    world.spawn((Name::new("ground"), Plane::default(), Checker { size: 0.5, ..Checker::default() }, Matte::default()));
    let sun = DirectionalLight { irradiance: Rgb::new(2.6, 2.5, 2.3), ..DirectionalLight::default() };
    world.spawn((Name::new("sun"), sun, LookAt { eye: [-1.5, 4.0, 2.5].into(), ..LookAt::default() }));
    world.spawn((Name::new("sky"), Background { colour: Rgb::new(0.35, 0.5, 0.7) }));
}
// ANCHOR_END: scene
