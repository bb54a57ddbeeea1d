//! Which samples are worth most? Four plates of metal, smooth to rough, show four lights, small to large, of equal power.
//! BSDF sampling suits the smooth plate, light sampling the rough one; neither suits both.
//! New here: `LightStrategy::Mis`, multiple importance sampling, which uses both and weights them.

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
    Chapter::new("26_choosing_samples", "choosing samples", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::direct_light())
        .offer(stages::lights())
        .offer(stages::area_lights())
        .offer(stages::bounces())
        .offer(stages::path_continuation())
        .offer(stages::specular_reflection())
        .offer(stages::glossy_reflection())
        .offer(stages::mis())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(32.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 2.0, 7.5].into(), target: [0.0, 1.3, 0.0].into(), ..LookAt::default() },
        Sampling { samples: 32, seed: 26, ..Sampling::default() },
        Integrator::Path { max_depth: 100, lights: LightStrategy::Mis, roulette: 5 },
    ));
    let grey = Matte { colour: Rgb::grey(0.3) };
    world.spawn((Name::new("floor"), Plane::default(), grey));
    let wall = Plane { normal: [0.0, 0.0, 1.0].into() };
    world.spawn((Name::new("wall"), wall, Placement::at(0.0, 0.0, -2.6), grey));

    for (name, x, radius, [r, g, b]) in [
        ("pinhead", -1.8, 0.04, [1.0, 0.55, 0.3]),
        ("marble", -0.65, 0.12, [0.9, 0.9, 0.4]),
        ("ball", 0.5, 0.32, [0.4, 0.9, 0.6]),
        ("globe", 1.8, 0.8, [0.4, 0.6, 1.0]),
    ] {
        // A light of a quarter of the area shines four times as brightly.
        let bright = 0.8 / (radius * radius);
        let emissive = Emissive { radiance: Rgb::new(bright * r, bright * g, bright * b), ..Emissive::default() };
        world.spawn((Name::new(name), Sphere { radius }, Placement::at(x, 2.6, -1.2), emissive));
    }
    // Each leans so that the eye sees the lights in it.
    for (name, y, z, lean, roughness) in [
        ("rough plate", 0.2, 2.3, 7.7, 0.25),
        ("brushed plate", 0.4, 1.25, 13.8, 0.1),
        ("satin plate", 0.75, 0.35, 20.1, 0.03),
        ("smooth plate", 1.2, -0.35, 26.5, 0.008),
    ] {
        let place =
            Placement { orientation: DQuat::from_rotation_x(Degrees(lean).radians()), ..Placement::at(0.0, y, z) };
        let metal = Metal { colour: Rgb::grey(0.85), roughness, ..Metal::default() };
        world.spawn((Name::new(name), Rectangle { width: 4.2, depth: 0.75 }, place, metal));
    }
}
// ANCHOR_END: scene
