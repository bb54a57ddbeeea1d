//! Scenes of mirrors, glass and metal.

use super::{Eye, Setup, leaning_triangle, lit_by_lights_alone, named};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::*;

/// Mirrors, one of them with normals of its own, and glass that absorbs and overlaps, under a lamp: nothing is left to
/// BSDF sampling.
///
/// All places lie on the grid of [`full`](super::full), so that it may be moved exactly.
pub fn specular(setup: Setup) -> World {
    let mut world = World::new();
    let look = LookAt { eye: setup.point(0.23, 1.43, 4.9), target: setup.point(0.01, 0.77, 0.02), up: DVec3::Y };
    setup.camera(&mut world, look);
    let at = |x, y, z| Placement { position: setup.point(x, y, z), ..Placement::default() };
    let sphere = |radius: f64| Sphere { radius: radius * setup.scale };
    let absorbing = |r: f64, g: f64, b: f64| Rgb::new(r / setup.scale, g / setup.scale, b / setup.scale);
    world.spawn((Name::new("ground"), Plane::default(), at(0.0, 0.017, 0.0), Matte { colour: Rgb::grey(0.6) }));
    world.spawn((Name::new("stone"), sphere(0.3), at(0.3, 0.32, 1.6), Matte { colour: Rgb::new(0.8, 0.3, 0.2) }));
    world.spawn((Name::new("silver"), sphere(0.7), at(-1.37, 0.75, 0.03), Mirror::default()));
    let gold = Metal { colour: Rgb::new(0.9, 0.7, 0.3), roughness: 1e-4, ..Metal::default() };
    world.spawn((Name::new("sail"), leaning_triangle(setup.scale), at(-0.5, 1.5, 0.25), gold));
    let green = Glass { absorption: absorbing(0.9, 0.1, 0.5), priority: 1, ..Glass::default() };
    world.spawn((Name::new("green ball"), sphere(0.6), at(0.2, 0.65, 0.3), green));
    let drink = Glass { ior: 1.33, absorption: absorbing(0.1, 0.5, 0.9), priority: 0 };
    let size = DVec3::new(0.9, 0.8, 0.7) * setup.scale;
    world.spawn((Name::new("drink"), Cuboid { size }, at(0.9, 0.5, 0.4), drink));
    let pane = ThinGlass { colour: Rgb::new(0.9, 0.6, 0.3), ..ThinGlass::default() };
    world.spawn((Name::new("bubble"), sphere(0.25), at(1.0, 0.27, 1.6), pane));
    world.spawn((Name::new("lamp"), setup.light(40.0, true), at(2.51, 4.02, 3.03)));
    world.spawn((Name::new("sky"), Background { colour: Rgb::new(0.3, 0.5, 0.8) }));
    lit_by_lights_alone(world)
}

/// The same beside rough metal, one part of it with normals of its own: random directions.
pub fn brushed(setup: Setup) -> World {
    let mut world = specular(setup);
    let at = |x, y, z| Placement { position: setup.point(x, y, z), ..Placement::default() };
    let metal = |roughness| Metal { colour: Rgb::new(0.8, 0.6, 0.5), roughness, ..Metal::default() };
    let rough = Metal { multiple_scattering: true, ..metal(0.6) };
    let frosted = RoughGlass { roughness: 0.3, ..RoughGlass::default() };
    let ball = Sphere { radius: 0.4 * setup.scale };
    world.spawn((Name::new("brushed ball"), ball, at(1.7, 0.42, 0.9), metal(0.15)));
    world.spawn((Name::new("rough sail"), leaning_triangle(setup.scale), at(0.8, 1.4, -0.4), rough));
    world.spawn((Name::new("frosted ball"), ball, at(-0.6, 0.42, 1.3), frosted));
    let camera = named(&mut world, "camera");
    world.entity_mut(camera).remove::<Integrator>().insert(Sampling { samples: 2, ..Sampling::default() });
    world
}

/// Adds a material of one kind to a scene of toggles.
pub(super) fn ball_of(world: &mut World, name: &'static str, x: f64, material: impl Bundle) {
    world.spawn((Name::new(name), Sphere { radius: 0.4 }, Placement::at(x, 0.5, 0.9), material));
}

/// Both, in both projections where that matters.
pub const MATERIAL: [(&str, fn(Setup) -> World, Eye); 3] = [
    ("specular", specular, Eye::Perspective),
    ("specular, orthographic", specular, Eye::Orthographic),
    ("brushed", brushed, Eye::Perspective),
];
