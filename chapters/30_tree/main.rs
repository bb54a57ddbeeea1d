//! A beach of pebbles and shells, near and far, large and small: which of all these does a ray have to look at?
//! The small shells are instances of one mesh: a tree over the shells, and within each the same tree over triangles.
//! New here: hierarchies over shapes and over triangles, and the views `boxes`, `tests` and `depth`.

#[path = "../28_meshes/seashell.rs"]
mod seashell;

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::*;
use pinhole::{Chapter, stages};
use seashell::seashell;
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("30_tree", "the tree", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::transforms())
        .offer(stages::direct_light())
        .offer(stages::lights())
        .offer(stages::environment())
        .offer(stages::bounces())
        .offer(stages::path_continuation())
}
// ANCHOR_END: chapter

/// π (3 − √5): the angle that never lets two things stand behind one another.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(34.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.2, 1.15, 4.4].into(), target: [0.0, 0.28, 0.0].into(), ..LookAt::default() },
        Sampling { samples: 16, seed: 30, ..Sampling::default() },
        Integrator::Path { max_depth: 3, lights: LightStrategy::Light, roulette: 0 },
    ));
    world.spawn((Name::new("sand"), Plane::default(), Matte { colour: Rgb::new(0.62, 0.5, 0.35) }));
    let sun = DirectionalLight { irradiance: Rgb::new(3.4, 2.7, 1.9), ..DirectionalLight::default() };
    world.spawn((Name::new("sun"), sun, LookAt { eye: [-3.0, 1.7, 1.6].into(), ..LookAt::default() }));
    world.spawn((Name::new("sky"), Gradient { bottom: Rgb::new(0.9, 0.7, 0.5), top: Rgb::new(0.12, 0.26, 0.55) }));

    let colours = [
        ("ochre", Rgb::new(0.75, 0.58, 0.45)),
        ("brown", Rgb::new(0.55, 0.42, 0.38)),
        ("cream", Rgb::new(0.82, 0.78, 0.7)),
        ("slate", Rgb::new(0.36, 0.38, 0.42)),
    ];
    let materials = colours.map(|(name, colour)| world.spawn((Name::new(name), Matte { colour })).id());
    let own = |number: usize| UsesMaterial(materials[number % 4]);

    // One large shell of many triangles, and about it pebbles and small shells, each a golden angle further round.
    let orientation = axis_angle(DVec3::Z, Degrees(66.0)) * axis_angle(DVec3::Y, Degrees(150.0));
    let place = Placement { position: [-0.1, 0.33, 0.4].into(), orientation, scale: DVec3::splat(0.75) };
    world.spawn((Name::new("large shell"), MeshInstance { geometry: seashell(200, 32) }, place, own(2)));
    for number in 0..720 {
        let (turn, ring) = (number as f64 * GOLDEN_ANGLE, 0.5 + 0.16 * (number as f64).sqrt());
        let radius = 0.02 + 0.07 * cubed((number as f64 * 0.754_877_67).fract());
        let place = Placement::at(ring * libm::cos(turn), 0.4 * radius, ring * libm::sin(turn));
        world.spawn((Name::new(format!("pebble {number}")), Sphere { radius }, place, own(number / 3)));
    }
    let geometry = seashell(64, 12);
    for number in 0..240 {
        let (turn, ring) = (1.3 + number as f64 * GOLDEN_ANGLE, 0.7 + 0.27 * (number as f64).sqrt());
        let size = 0.05 + 0.07 * (number as f64 * 0.414_214).fract();
        let orientation = axis_angle(DVec3::Y, Degrees(170.0 * turn)) * axis_angle(DVec3::Z, Degrees(83.0));
        let position = [ring * libm::cos(turn), 0.3 * size, ring * libm::sin(turn)].into();
        let place = Placement { position, orientation, scale: DVec3::splat(size) };
        world.spawn((
            Name::new(format!("shell {number}")),
            MeshInstance { geometry: geometry.clone() },
            place,
            own(number),
        ));
    }
}
// ANCHOR_END: scene

/// Few are large.
fn cubed(part: f64) -> f64 {
    part * part * part
}
