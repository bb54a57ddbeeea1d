//! Meshes: a model of many triangles is one shape, and any number of entities may place it.
//! Shells on sand, all of them two models; each entity says where, how large and of what material.
//! New here: `MeshInstance`, and the stages "Intersect meshes" and "Compute surfaces: meshes".

mod sand;
mod seashell;

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::*;
use pinhole::{Chapter, stages};
use seashell::{MOON, TOWER, coiled};
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("28_meshes", "meshes and a model of your own", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::transforms())
        .offer(stages::textures())
        .offer(stages::environment())
        .offer(stages::direct_light())
        .offer(stages::lights())
        .offer(stages::bounces())
        .offer(stages::path_continuation())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(26.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 1.35, 5.0].into(), target: [0.05, 0.4, 0.0].into(), ..LookAt::default() },
        Sampling { samples: 32, seed: 28, ..Sampling::default() },
    ));
    let [tower, moon] = [coiled(&TOWER, 300, 16), coiled(&MOON, 100, 24)].map(|geometry| MeshInstance { geometry });
    let mut shell = |name: &'static str, model: &MeshInstance, place: Placement, turns: &[(DVec3, f64)], colour| {
        let turned = turns.iter().map(|&(axis, angle)| axis_angle(axis, Degrees(angle))).product();
        let place = Placement { orientation: turned, ..place };
        // A clone of the instance has the same triangles.
        world.spawn((Name::new(name), model.clone(), place, Matte { colour })).id()
    };
    let at = |position: [f64; 3], scale: [f64; 3]| Placement {
        position: position.into(),
        scale: scale.into(),
        ..Placement::default()
    };
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    let lying = [(y, 23.0), (z, 76.0), (y, -29.0)];
    shell("lying tower", &tower, at([-0.55, 0.36, 0.4], [0.9; 3]), &lying, Rgb::new(0.8, 0.5, 0.33));
    let standing = at([0.55, 0.78, -0.95], [0.62, 0.95, 0.62]);
    shell("standing tower", &tower, standing, &[(z, -6.0), (y, -69.0)], Rgb::new(0.62, 0.34, 0.24));
    let small = [(y, -29.0), (z, 83.0)];
    shell("small tower", &tower, at([-1.4, 0.08, 1.15], [0.24; 3]), &small, Rgb::new(0.75, 0.68, 0.6));
    let leaning = [(y, -40.0), (x, 9.0)];
    let striped = shell("striped moon", &moon, at([1.15, 0.33, 0.35], [0.48; 3]), &leaning, Rgb::grey(0.8));
    let back = [(y, 126.0), (x, -23.0)];
    shell("grey moon", &moon, at([-1.65, 0.22, -0.9], [0.33; 3]), &back, Rgb::new(0.55, 0.47, 0.5));
    let front = [(y, 11.0), (z, 34.0)];
    shell("small moon", &moon, at([0.45, 0.12, 1.25], [0.2; 3]), &front, Rgb::new(0.85, 0.66, 0.5));
    // Along the spiral, since u goes round the tube.
    let (cream, brown) = (Rgb::new(0.85, 0.78, 0.68), Rgb::new(0.45, 0.25, 0.15));
    let stripes = Stripes { first: cream, second: brown, size: 0.125, by: TextureBy::Uv, ..Stripes::default() };
    world.entity_mut(striped).insert(stripes);

    let sand = MeshInstance { geometry: sand::sand(56, 48) };
    world.spawn((Name::new("sand"), sand, Matte { colour: Rgb::new(0.72, 0.58, 0.4) }));
    let sun = DirectionalLight { irradiance: Rgb::new(3.2, 2.3, 1.4), ..DirectionalLight::default() };
    world.spawn((Name::new("sun"), sun, LookAt { eye: [-4.0, 1.9, 1.6].into(), ..LookAt::default() }));
    world.spawn((Name::new("sky"), Gradient { bottom: Rgb::new(1.0, 0.68, 0.45), top: Rgb::new(0.1, 0.3, 0.7) }));
}
// ANCHOR_END: scene
