use super::{Setup, named};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::*;

/// A floor and a ball under an evening sky, a lamp that shines on one side and one that shines all round, all of them
/// sampled.
///
/// All places lie on the grid of [`full`](super::full), and nothing but the view is turned.
pub fn soft(setup: Setup) -> World {
    let mut world = World::new();
    let look = LookAt { eye: setup.point(0.23, 1.03, 4.9), target: setup.point(0.01, 0.77, 0.02), up: DVec3::Y };
    setup.camera(&mut world, look);
    let camera = named(&mut world, "camera");
    world.entity_mut(camera).insert(Integrator::DISTRIBUTION);
    let at = |x, y, z| Placement { position: setup.point(x, y, z), ..Placement::default() };
    let matte = |r, g, b| Matte { colour: Rgb::new(r, g, b) };
    world.spawn((Name::new("floor"), Plane::default(), at(0.0, 0.017, 0.0), matte(0.6, 0.5, 0.4)));
    world.spawn((Name::new("ball"), Sphere { radius: 0.6 * setup.scale }, at(-0.5, 0.6, 0.3), matte(0.2, 0.4, 0.8)));
    let shines = |sides| Emissive { radiance: Rgb::new(3.0, 2.0, 1.0), sides };
    // It shines upward, away from the floor.
    let tray = Rectangle { width: 1.0 * setup.scale, depth: 0.7 * setup.scale };
    world.spawn((Name::new("tray"), tray, at(0.9, 0.4, 0.2), shines(Sides::Front)));
    world.spawn((Name::new("globe"), Sphere { radius: 0.3 * setup.scale }, at(1.0, 1.9, 0.4), shines(Sides::Both)));
    let file = "chapters/16_textures/evening.hdr".into();
    world.spawn((Name::new("evening"), Environment { file, turn: Degrees(30.0), scale: 2.0 }));
    world
}
