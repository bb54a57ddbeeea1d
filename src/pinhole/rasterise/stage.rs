//! The stage that fills the hits of a tile by rasterisation.

use super::cover::Cover;
use super::spaces::{Projection, RayProjection};
use super::table::RasterTriangles;
use super::triangle::RasterTriangle;
use crate::extract::rasterisation_evidence;
use crate::intersect::{HitPrimitives, Hits};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems};
use crate::rays::{ActivePixels, RasterPoints, Tile, WorldRays};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;

/// The raster points and rays of a tile, and the hits that rasterisation fills.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct RasterView {
    tile: &'static Tile,
    active: Option<&'static ActivePixels>,
    raster: &'static RasterPoints,
    rays: &'static WorldRays,
    hits: &'static mut Hits,
    primitives: Option<&'static mut HitPrimitives>,
}

/// Finds the nearest triangle at each raster point of a tile, and the t at which the camera ray through that point hits
/// the triangle's plane.
///
/// The ray itself may pass a hair beside the triangle, for vertices are rounded to 1/256 of a pixel.
pub fn rasterise_triangles(
    projection: Res<Shared<Projection>>,
    table: Res<Shared<RasterTriangles>>,
    mut cover: Local<Cover>,
    mut tiles: Query<RasterView>,
) {
    let to_raster = RayProjection::new(&projection);
    for mut view in &mut tiles {
        let (tile, raster) = (view.tile, view.raster);
        let in_order = raster.rows() == tile.rows() && view.active.is_none_or(|active| active.0.len() == tile.rows());
        cover.fill(&table, tile, raster, in_order);
        for row in 0..raster.rows() {
            if let Some(number) = cover.nearest(row) {
                let triangle = table.triangle(number);
                let ray = [view.rays.origin_of(row), view.rays.direction_of(row)];
                view.keep(row, triangle, to_raster.t(ray, &triangle.plane));
            }
        }
    }
}

impl RasterViewItem<'_, '_> {
    /// Keeps a hit where it is the closest so far.
    #[inline(always)]
    fn keep(&mut self, row: usize, &RasterTriangle { shape, primitive, .. }: &RasterTriangle, t: f64) {
        let hits = &mut self.hits;
        if t < hits.t[row] || (t == hits.t[row] && shape < hits.shape[row]) {
            (hits.t[row], hits.shape[row]) = (t, shape);
            if let Some(primitives) = &mut self.primitives {
                primitives.primitive[row] = primitive;
            }
        }
    }
}

/// The stage that runs this system.
pub fn rasterise_stage() -> Stage {
    Stage::new("Rasterise triangles", TileSystems::Intersect, rasterise_triangles)
        .kind(StageKind::Alternative)
        .on_first_bounce()
        .on_camera_paths()
        .when(rasterisation_evidence)
}
