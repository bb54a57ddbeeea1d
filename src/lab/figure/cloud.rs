//! A cloud: a medium whose density is noise on a grid.

use super::Figure;
use super::compared::{LARGE, exhibit, rows, sampled};
use super::picture::Picture;
use super::svg::Drawing;
use crate::measure::draws::Draws;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::{
    Cuboid, Degrees, DensityGrid, DirectionalLight, FovAxis, Gradient, Integrator, LightStrategy, LookAt, Matte,
    Medium, Name, PerspectiveCamera, Placement, Plane, Rgb,
};
use pinhole::{Chapter, Result};

/// Noise between 0 and 1 on a lattice of whole numbers, interpolated smoothly.
fn lattice_noise(at: DVec3) -> f64 {
    let (cell, within) = (at.floor(), at - at.floor());
    let smooth = within * within * (3.0 - 2.0 * within);
    let corner = |x: i64, y: i64, z: i64| {
        let place = [cell.x as i64 + x, cell.y as i64 + y, cell.z as i64 + z];
        let number = place.iter().fold(7, |all: u64, &part| all.wrapping_mul(1_000_003).wrapping_add(part as u64));
        Draws::new(number, 0).unit()
    };
    let along = |y, z| corner(0, y, z) * (1.0 - smooth.x) + corner(1, y, z) * smooth.x;
    let across = |z| along(0, z) * (1.0 - smooth.y) + along(1, z) * smooth.y;
    across(0) * (1.0 - smooth.z) + across(1) * smooth.z
}

/// A cloud: four octaves of noise, thinned towards the sides of its box, above a flat base.
pub fn cloud() -> DensityGrid {
    DensityGrid::of([44, 24, 30], |at| {
        let octave = |number: i32| {
            let scale = f64::from(1 << number);
            lattice_noise(at * DVec3::new(2.2, 1.2, 1.5) * 1.7 * scale + 11.0) / scale
        };
        let noise = (octave(0) + octave(1) + octave(2) + octave(3)) / 1.875;
        let base = ((at.y + 0.75) * 5.0).clamp(0.0, 1.0);
        let away = DVec3::new(at.x, (at.y + 0.55) * 0.85, at.z).length_squared();
        (base * 4.0 * (noise * 1.5 - 0.2 - away)).clamp(0.0, 1.0)
    })
}

/// A box of fog in sunlight above the ground.
fn fog_bank(world: &mut World) {
    let look = LookAt { eye: DVec3::new(0.8, 0.9, 7.5), target: DVec3::new(0.0, 1.55, 0.0), ..LookAt::default() };
    world.spawn((
        PerspectiveCamera { fov: Degrees(26.0), axis: FovAxis::Vertical },
        look,
        Integrator::Path { max_depth: 32, lights: LightStrategy::Mis, roulette: 5 },
    ));
    world.spawn((Plane::default(), Matte { colour: Rgb::new(0.32, 0.3, 0.22) }));
    let medium = Medium { scattering: Rgb::grey(16.0), anisotropy: 0.5, ..Medium::default() };
    let scale = DVec3::new(2.2, 1.2, 1.5);
    let place = Placement { scale, ..Placement::at(0.0, 1.9, 0.0) };
    world.spawn((Name::new("cloud"), Cuboid::default(), place, medium));
    let sun = DirectionalLight { irradiance: Rgb::new(3.0, 2.7, 2.2), ..DirectionalLight::default() };
    world.spawn((sun, LookAt { eye: DVec3::new(4.0, 5.0, 3.0), target: DVec3::ZERO, ..LookAt::default() }));
    world.spawn(Gradient { bottom: Rgb::new(0.35, 0.42, 0.5), top: Rgb::new(0.1, 0.22, 0.5) });
}

/// The same medium with one density, and with that of a grid.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let with_grid = |world: &mut World| {
        fog_bank(world);
        let mut bodies = world.query_filtered::<Entity, With<Medium>>();
        let bodies: Vec<Entity> = bodies.iter(world).collect();
        bodies.into_iter().for_each(|body| _ = world.entity_mut(body).insert(cloud()));
    };
    let even = Picture::of(&chapter.clone().with_scene(fog_bank), LARGE, None, sampled(4, 25));
    let varied = Picture::of(&chapter.clone().with_scene(with_grid), LARGE, None, sampled(10, 25));
    let exhibits = [
        exhibit(even, ["one density", "1 everywhere in the box"]),
        exhibit(varied, ["a density grid", "44 × 24 × 30 voxels in the same box"]),
    ];
    rows(chapter, figure, LARGE, exhibits)
}
