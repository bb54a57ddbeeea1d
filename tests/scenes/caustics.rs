//! Scenes with caustics, by the camera's rays alone and with rays from the lamps.

use super::named;
use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use pinhole::scene::*;
use std::f64::consts::PI;

/// A ball of glass that absorbs, half a ring of mirror and a sheet of paper with normals of their corners, metal, and
/// lamps: points, or such with an area, one of which stands in tinted glass.
pub fn caustics(lamps: bool) -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.3, 2.6, 3.6), target: DVec3::new(0.0, 0.3, 0.0), up: DVec3::Y };
    let fov = PerspectiveCamera { fov: Degrees(48.0), ..Default::default() };
    let camera = (Name::new("camera"), look, fov, Resolution { width: 48, height: 32 });
    world.spawn((camera, Integrator::Path { max_depth: 9, lights: LightStrategy::Mis, roulette: 3 }));
    let place = Placement::at(0.0, 0.0, 0.0);
    world.spawn((
        Name::new("floor"),
        Rectangle { width: 6.0, depth: 6.0 },
        place,
        Matte { colour: Rgb::new(0.8, 0.7, 0.6) },
    ));
    let glass = Glass { absorption: Rgb::new(0.1, 0.4, 0.8), ..Glass::default() };
    world.spawn((Name::new("ball"), Sphere { radius: 0.5 }, Placement::at(-0.6, 0.6, 0.2), glass));
    let metal = Metal { colour: Rgb::new(0.9, 0.8, 0.5), roughness: 0.3, ..Metal::default() };
    world.spawn((Name::new("coin"), Disk { radius: 0.5 }, Placement::at(-0.9, 0.02, 1.2), metal));
    const PARTS: u32 = 8;
    let silver = world.spawn((Name::new("silver"), Mirror { colour: Rgb::new(0.9, 0.85, 0.8) })).id();
    let corner = |part: u32, height: f64| {
        let angle = PI * f64::from(part) / f64::from(PARTS) - 0.9 * PI;
        let out = DVec3::new(libm::cos(angle), 0.0, libm::sin(angle));
        (DVec3::new(0.9, height, 0.2) + 0.8 * out, -out)
    };
    for part in 0..PARTS {
        let corners = [corner(part, 0.0), corner(part + 1, 0.0), corner(part + 1, 0.6), corner(part, 0.6)];
        for pick in [[0, 1, 2], [0, 2, 3]] {
            let (vertices, normals) = (pick.map(|at| corners[at].0), pick.map(|at| corners[at].1));
            world.spawn((Triangle { vertices, normals: Some(normals), uvs: None }, UsesMaterial(silver)));
        }
    }
    // Its normals lean far enough that light falls on it that they do not see, and the other way round.
    let vertices = [DVec3::new(-0.4, 0.05, 0.9), DVec3::new(0.5, 0.05, 1.6), DVec3::new(0.6, 0.05, 0.6)];
    let normals = [DVec3::new(0.9, 0.4, 0.2), DVec3::new(-0.9, 0.4, 0.1), DVec3::new(-0.2, 0.4, -0.9)];
    let paper = Matte { colour: Rgb::new(0.9, 0.85, 0.8) };
    world.spawn((Name::new("paper"), Triangle { vertices, normals: Some(normals), uvs: None }, paper));
    if lamps {
        let tinted = Glass { absorption: Rgb::new(0.5, 1.0, 3.0), ..Glass::default() };
        let jar = Placement::at(1.6, 0.5, 1.2);
        world.spawn((Name::new("jar"), Sphere { radius: 0.4 }, jar, tinted));
        let emissive = Emissive { radiance: Rgb::new(14.0, 12.0, 10.0), ..Emissive::default() };
        world.spawn((Name::new("bulb"), Sphere { radius: 0.2 }, jar, emissive));
        let emissive = Emissive { radiance: Rgb::new(6.0, 5.5, 5.0), sides: Sides::Both };
        world.spawn((Name::new("lamp"), Sphere { radius: 0.5 }, Placement::at(-1.6, 2.4, -0.4), emissive));
        let front = Emissive { radiance: Rgb::new(3.0, 4.0, 5.0), sides: Sides::Front };
        let down = Placement { orientation: DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0), ..Placement::at(1.0, 2.2, 0.9) };
        world.spawn((Name::new("panel"), Rectangle { width: 0.9, depth: 0.7 }, down, front));
    } else {
        world.spawn((PointLight { intensity: Rgb::grey(9.0), casts_shadows: true }, Placement::at(-1.6, 2.4, 0.4)));
        let ahead = LookAt { eye: DVec3::new(1.8, 2.2, 1.4), target: DVec3::new(0.5, 0.3, 0.0), up: DVec3::Y };
        world.spawn((SpotLight { intensity: Rgb::grey(12.0), ..SpotLight::default() }, ahead));
    }
    world
}

/// The same with rays from the lamps.
pub fn traced(make: impl Fn() -> World) -> impl Fn() -> World {
    move || {
        let mut world = make();
        let camera = named(&mut world, "camera");
        world.entity_mut(camera).insert(LightTracing::default());
        world
    }
}
