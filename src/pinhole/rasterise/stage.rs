//! The stage that fills the hits of a tile by rasterisation.

use super::cover::Cover;
use super::spaces::Projection;
use super::table::RasterTriangles;
use super::triangle::RasterTriangle;
use crate::extract::{MeshTable, TriangleTable, kind_evidence, rasterisation_evidence};
use crate::intersect::{HitPrimitives, Hits, NO_PRIMITIVE};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems};
use crate::rays::{ActivePixels, RasterPoints, Tile, WorldRays};
use crate::shapes::{PlacedMesh, TriangleRow, triangle_t};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::DVec3;

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
/// it.
///
/// A ray may pass a hair beside a triangle that covers its raster point, for vertices are rounded to 1/256 of a pixel; t
/// is then that of the triangle's plane.
pub fn rasterise_triangles(
    projection: Res<Shared<Projection>>,
    table: Res<Shared<RasterTriangles>>,
    triangles: Option<Res<Shared<TriangleTable>>>,
    meshes: Option<Res<Shared<MeshTable>>>,
    mut cover: Local<Cover>,
    mut tiles: Query<RasterView>,
) {
    for RasterViewItem { tile, active, raster, rays, mut hits, mut primitives } in &mut tiles {
        let in_order = raster.rows() == tile.rows() && active.is_none_or(|active| active.0.len() == tile.rows());
        cover.fill(&table, tile, raster, in_order);
        for row in 0..raster.rows() {
            let Some((number, nearness)) = cover.nearest(row) else { continue };
            let triangle = &table.triangles[number];
            let ray = [rays.origin_of(row), rays.direction_of(row)];
            let t = match (&triangles, &meshes) {
                (_, Some(meshes)) if triangle.primitive != NO_PRIMITIVE => {
                    meshes.row[triangle.row as usize].triangle_t(ray, triangle.primitive)
                }
                (Some(triangles), _) => triangle_t(ray[0], ray[1], &triangles.row[triangle.row as usize]),
                _ => f64::INFINITY,
            };
            let t = if t < f64::INFINITY { t } else { plane_t(&projection, ray[1], nearness) };
            let RasterTriangle { shape, primitive, .. } = *triangle;
            if t < hits.t[row] || (t == hits.t[row] && shape < hits.shape[row]) {
                (hits.t[row], hits.shape[row]) = (t, shape);
                if let Some(primitives) = &mut primitives {
                    primitives.primitive[row] = primitive;
                }
            }
        }
    }
}

/// The t at which a camera ray has the depth that a nearness stands for.
fn plane_t(projection: &Projection, direction: DVec3, nearness: f64) -> f64 {
    let depth = if projection.is_perspective { 1.0 / nearness } else { -nearness };
    depth / -projection.camera_from_world.mul_vec3(direction).z
}

/// The stage that runs this system.
pub fn rasterise_stage() -> Stage {
    Stage::new("Rasterise triangles", TileSystems::Intersect, rasterise_triangles)
        .kind(StageKind::Alternative)
        .on_first_bounce()
        .on_camera_paths()
        .table_where::<TriangleTable>(kind_evidence::<TriangleRow>)
        .table_where::<MeshTable>(kind_evidence::<PlacedMesh>)
        .when(rasterisation_evidence)
}
