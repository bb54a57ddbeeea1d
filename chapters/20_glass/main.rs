//! What does a surface of glass do with light? It reflects a part and refracts the rest.
//! A clear ball with a bubble of air, and a drink in a thick glass that it wets.
//! New here: refraction, Fresnel's equations, absorption, and glass within glass.

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
    Chapter::new("20_glass", "glass", scene)
        .offer(stages::camera_rays())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::textures())
        .offer(stages::environment())
        .offer(stages::direct_light())
        .offer(stages::lights())
        .offer(stages::bounces())
        .offer(stages::specular_reflection())
        .offer(stages::glass())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(32.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.4, 2.2, 6.2].into(), target: [0.0, 0.85, 0.0].into(), ..LookAt::default() },
        Integrator::Whitted { max_depth: 20 },
    ));
    let ball = Placement::at(-1.3, 1.0, 0.0);
    world.spawn((Name::new("ball"), Sphere { radius: 1.0 }, ball, Glass::default()));
    let air = Glass { ior: 1.0, priority: 2, ..Glass::default() };
    world.spawn((Name::new("bubble"), Sphere { radius: 0.35 }, Placement::at(-1.05, 1.25, 0.25), air));

    // The walls reach into each other a little; the drink reaches into the walls, which are there first.
    let block = |size: [f64; 3]| Cuboid { size: size.into() };
    let wall = world.spawn((Name::new("thick glass"), Glass { priority: 1, ..Glass::default() })).id();
    for (name, size, x, y, z) in [
        ("base", [1.49, 0.3, 1.49], 1.4, 0.151, 0.0),
        ("left wall", [0.15, 1.6, 1.5], 0.725, 0.95, 0.0),
        ("right wall", [0.15, 1.6, 1.5], 2.075, 0.95, 0.0),
        ("front wall", [1.34, 1.59, 0.15], 1.4, 0.95, 0.665),
        ("back wall", [1.34, 1.59, 0.15], 1.4, 0.95, -0.665),
    ] {
        world.spawn((Name::new(name), block(size), Placement::at(x, y, z), UsesMaterial(wall)));
    }
    let drink = Glass { ior: 1.33, absorption: Rgb::new(0.15, 0.9, 1.8), priority: 0 };
    world.spawn((Name::new("drink"), block([1.35, 1.0, 1.33]), Placement::at(1.4, 0.7, 0.0), drink));

    let tiles = Checker { first: Rgb::new(0.6, 0.6, 0.58), second: Rgb::new(0.15, 0.2, 0.3), ..Checker::default() };
    world.spawn((Name::new("floor"), Plane::default(), Matte::default(), tiles));
    let sun = DirectionalLight { irradiance: Rgb::grey(2.6), ..DirectionalLight::default() };
    let high = LookAt { eye: [-3.0, 5.5, 3.0].into(), target: [0.0, 0.0, 0.0].into(), ..LookAt::default() };
    world.spawn((Name::new("sun"), sun, high));
    world.spawn((Name::new("sky"), Gradient::default()));
}
// ANCHOR_END: scene
