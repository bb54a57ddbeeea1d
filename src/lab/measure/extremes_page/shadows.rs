//! A frame's light, as its own stages have it and as naive starts of shadow rays would.

use super::Picture;
use crate::naive::shadow::ShadowStart;
use bevy_ecs::prelude::*;
use glam::Vec3;
use pinhole::Result;
use pinhole::extract::{PlaneTable, SphereTable};
use pinhole::film::{Curve, FilmTile};
use pinhole::intersect::Surfaces;
use pinhole::plan::{Census, Stage, Table, VectorRows};
use pinhole::render::inspect;
use pinhole::shade::ShadowRays;
use pinhole::shapes::{plane_t, sphere_t};

/// The frame's own picture, and the same where every shadow ray starts as `start` has it; nothing where no light falls.
///
/// The naive rays go the same way and look as far, and their kernels are pinhole's: only the start differs.
pub fn with_start(
    scene: &World,
    offer: &[Stage],
    size: [u32; 2],
    start: fn(Vec3, Vec3) -> ShadowStart,
) -> Result<Option<[Picture; 2]>> {
    let frame = inspect(scene, offer, size[0].max(size[1]))?;
    let census = &Census::of(scene);
    let (spheres, planes) = (SphereTable::extract(census)?, PlaneTable::extract(census)?);
    let tile = frame.world.entity(frame.tiles[0]);
    let (Some(film), Some(surfaces), Some(rays)) =
        (tile.get::<FilmTile>(), tile.get::<Surfaces>(), tile.get::<ShadowRays>())
    else {
        return Ok(None);
    };
    let own: Vec<[f32; 3]> = (0..film.count.len()).map(|row| film.mean(row)).collect();
    let mut naive = own.clone();
    let is_lit = |row: usize| surfaces.get(row).normal != Vec3::ZERO;
    (0..naive.len()).filter(|&row| is_lit(row)).for_each(|row| naive[row] = [0.0; 3]);
    for ray in 0..rays.row.len() {
        let row = rays.row[ray] as usize;
        let surface = surfaces.get(row);
        let ShadowStart { origin, t_min } = start(surface.position, surface.normal);
        let direction = rays.direction(ray);
        let (o, d) = (origin.as_dvec3(), direction.as_dvec3());
        let counts = |t: f64| t > f64::from(t_min) && t < f64::from(rays.t_max[ray]);
        let of_sphere = |row: usize| counts(sphere_t(o, d, spheres.row[row].centre, spheres.row[row].radius));
        let of_plane = |row: usize| counts(plane_t(o, d, planes.row[row].normal, planes.row[row].offset));
        let blocked = (0..spheres.row.len()).any(of_sphere) || (0..planes.row.len()).any(of_plane);
        if !blocked {
            for (part, brings) in naive[row].iter_mut().zip(rays.irradiance.at(ray)) {
                *part += brings;
            }
        }
    }
    Ok(Some([own, naive].map(|pixels| Picture { width: size[0], pixels, curve: Curve::Srgb })))
}
