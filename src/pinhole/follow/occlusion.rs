use crate::each::{list_those, set_all};
use crate::extract::{IntegratorTable, SamplingTable, occlusion_evidence};
use crate::intersect::{Hits, NO_SHAPE, Surfaces, shape_evidence};
use crate::material::{cosine_direction, frame_of};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems, VectorRowsMut};
use crate::rays::{Depth, Draws, PixelSamples, SampleNumber, Tile, draws_of_two};
use crate::sample::Purpose;
use crate::shade::{Radiance, ShadowHits, ShadowRays};
use crate::shapes::offset_origin;
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::DVec3;
use std::f64::consts::PI;

// ANCHOR: sample_sky
/// Traces a cosine-weighted ray towards the sky from every surface.
///
/// A sky of radiance 1 gives the irradiance π; each of these rays is worth π where it escapes and 0 where it is
/// blocked, and their mean is the irradiance of the visible part of the sky.
pub fn sample_sky(
    sampling: Res<Shared<SamplingTable>>,
    integrator: Res<Shared<IntegratorTable>>,
    lists: Local<SkyLists>,
    tiles: Query<SkyView>,
) {
    sample_sky_with(cosine_direction, (&sampling, &integrator), lists, tiles);
}

/// The rows with a surface, and their random numbers; reused from tile to tile.
#[derive(Default)]
pub struct SkyLists {
    row: Vec<u32>,
    points: Vec<[f64; 2]>,
}

/// The columns that sampling the sky reads and writes.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct SkyView {
    tile: &'static Tile,
    number: Option<&'static SampleNumber>,
    samples: Option<&'static PixelSamples>,
    hits: &'static Hits,
    surfaces: &'static Surfaces,
    rays: &'static mut ShadowRays,
}

/// Traces a ray of irradiance π from every surface, in the direction about its normal that `direction_of` makes from
/// two random numbers.
pub fn sample_sky_with(
    direction_of: impl Fn([f64; 2]) -> DVec3,
    (sampling, integrator): (&SamplingTable, &IntegratorTable),
    mut lists: Local<SkyLists>,
    mut tiles: Query<SkyView>,
) {
    let SkyLists { row: list, points } = &mut *lists;
    for SkyViewItem { tile, number, samples, hits, surfaces, mut rays } in &mut tiles {
        list_those(hits.shape.iter().enumerate().map(|(row, &shape)| (row as u32, shape != NO_SHAPE)), list);
        let draws = Draws { sampling, tile, number, samples, paths: None, depth: Depth(0) };
        draws_of_two(&draws, Purpose::Direction, list, points);
        let (path, mut origin, mut direction, t_max, mut irradiance) = rays.slices_mut(list.len());
        path.copy_from_slice(list);
        set_all(t_max, integrator.distance);
        irradiance.set_all([PI as f32; 3]);
        for (at, &row) in list.iter().enumerate() {
            let surface = surfaces.get(row as usize);
            origin.put(at, offset_origin(surface.position, surface.normal, surface.bound));
            direction.put(at, (frame_of(surface.normal.as_dvec3()) * direction_of(points[at])).as_vec3());
        }
    }
}
// ANCHOR_END: sample_sky

/// Shows white where a row's ray, or the ray from its surface, escapes from the scene, and black where something hides
/// the sky.
pub fn show_occlusion(mut tiles: Query<(Option<&Hits>, Option<(&ShadowRays, &ShadowHits)>, &mut Radiance)>) {
    for (hits, rays, mut radiance) in &mut tiles {
        let rows = radiance.rows();
        let mut radiance = radiance.slices_mut(rows);
        for row in (0..rows).filter(|&row| hits.is_none_or(|hits| hits.shape[row] == NO_SHAPE)) {
            radiance.put(row, [1.0; 3]);
        }
        let Some((rays, shadows)) = rays else { continue };
        for ray in (0..rays.rows()).filter(|&ray| shadows.shape[ray] == NO_SHAPE) {
            let row = rays.row[ray] as usize;
            radiance.put(row, [1.0; 3]);
        }
    }
}

/// The stage that samples the sky.
pub fn sky_rays_stage() -> Stage {
    Stage::new("Sample the open sky", TileSystems::SampleLights, sample_sky)
        .kind(StageKind::Alternative)
        .appends::<ShadowRays>()
        .when(|scene| occlusion_evidence(scene).and(|| shape_evidence(scene)))
}

/// The stage that shows ambient occlusion.
pub fn sky_stage() -> Stage {
    Stage::new("Show ambient occlusion", TileSystems::Shade, show_occlusion)
        .on_camera_paths()
        .kind(StageKind::Alternative)
        .when(occlusion_evidence)
}
