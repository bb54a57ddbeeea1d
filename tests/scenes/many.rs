//! A scene with many lights of every kind, so that one of each is chosen for a surface.

use super::Setup;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::*;
use pinhole_lab::measure::torus_knot::torus_knot;

/// A floor, a brushed ball and a mirror under an emitting knot, a row of small lamps, 70 point lights and 70 spots, of
/// which some cast no shadows.
pub fn many_lights(setup: Setup) -> World {
    let mut world = World::new();
    let look = LookAt { eye: setup.point(0.2, 2.4, 4.2), target: setup.point(0.0, 0.4, 0.0), up: DVec3::Y };
    setup.camera(&mut world, look);
    let camera = super::named(&mut world, "camera");
    let path = Integrator::Path { max_depth: 5, lights: LightStrategy::Mis, roulette: 0 };
    let sampling = Sampling { samples: 4, ..Sampling::default() };
    world.entity_mut(camera).insert((path, sampling));
    let at = |x, y, z| Placement { position: setup.point(x, y, z), ..Placement::default() };
    let size = |size: f64| DVec3::splat(size * setup.scale);
    let grey = Matte { colour: Rgb::new(0.7, 0.6, 0.5) };
    world.spawn((
        Name::new("floor"),
        Rectangle { width: 6.0 * setup.scale, depth: 6.0 * setup.scale },
        at(0.0, 0.0, 0.0),
        grey,
    ));
    let ball = Sphere { radius: 0.4 * setup.scale };
    world.spawn((ball, at(0.9, 0.4, 0.5), Metal { roughness: 0.3, ..Metal::default() }));
    world.spawn((ball, at(-0.9, 0.4, 0.6), Mirror::default()));
    let knot = MeshInstance { geometry: MeshGeometry::new(torus_knot(20, 5)) };
    let placed = Placement { scale: size(0.25), ..at(0.1, 1.3, -0.6) };
    let glow = |r, g, b, sides| Emissive { radiance: Rgb::new(r, g, b), sides };
    world.spawn((Name::new("knot"), knot, placed, glow(1.0, 0.8, 0.5, Sides::Front)));
    for number in 0..12 {
        let lamp = at(0.45 * f64::from(number) - 2.5, 0.3, 1.4);
        world.spawn((Sphere { radius: 0.03 * setup.scale }, lamp, glow(2.0, 4.0, 9.0, Sides::Both)));
    }
    for number in 0..70 {
        let (x, z) = (f64::from(number % 10) * 0.6 - 2.7, f64::from(number / 10) * 0.7 - 2.4);
        world.spawn((setup.light(0.02, number % 3 > 0), at(x, 0.5, z)));
        let spot = SpotLight {
            intensity: Rgb::grey(0.1 * setup.scale * setup.scale),
            inner_angle: Degrees(20.0),
            outer_angle: Degrees(50.0),
            casts_shadows: number % 4 > 0,
        };
        let look = LookAt { eye: setup.point(x, 1.0, z), target: setup.point(x + 0.3, 0.0, z), up: DVec3::X };
        world.spawn((spot, look));
    }
    world
}
