//! The stage that fills the hits of a tile by rasterisation.

use super::cover::Cover;
use super::spaces::Projection;
use super::table::RasterTriangles;
use super::triangle::RasterTriangle;
use crate::extract::{MeshTable, TriangleTable, kind_evidence, rasterisation_evidence};
use crate::intersect::{HitPrimitives, Hits, NO_PRIMITIVE};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems};
use crate::rays::{ActivePixels, RasterPoints, Tile, WorldRays};
use crate::shapes::{PAIRS, PlacedMesh, TrianglePairs, TriangleRow, triangle_t};
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
    mut found: Local<(Cover, TrianglePairs)>,
    mut tiles: Query<RasterView>,
) {
    let (cover, pairs) = &mut *found;
    let shapes = (triangles.as_deref(), meshes.as_deref());
    for mut view in &mut tiles {
        let (tile, raster) = (view.tile, view.raster);
        let in_order = raster.rows() == tile.rows() && view.active.is_none_or(|active| active.0.len() == tile.rows());
        cover.fill(&table, tile, raster, in_order);
        let mut seen = (0..raster.rows()).filter_map(|row| cover.nearest(row).map(|nearest| (row, nearest)));
        let (mut some, mut count) = ([Seen::default(); PAIRS], PAIRS);
        while count == PAIRS {
            count = 0;
            for (row, (number, nearness)) in seen.by_ref().take(PAIRS) {
                let triangle = table.triangle(number);
                let start = set_pair(pairs, count, view.ray(row), shapes, triangle);
                some[count] = Seen { row, number, nearness, start };
                count += 1;
            }
            let found = pairs.t();
            for (&Seen { row, number, nearness, start }, t) in some[..count].iter().zip(found) {
                let triangle = table.triangle(number);
                let t = if t.is_nan() { uncertain_t(view.ray(row), triangle, shapes) } else { start + t };
                let t = if t < f64::INFINITY { t } else { plane_t(&projection, view.ray(row)[1], nearness) };
                view.keep(row, triangle, t);
            }
        }
    }
}

/// A row that sees a triangle.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    row: usize,
    /// The triangle's number.
    number: usize,
    nearness: f64,
    /// The t at which the ray starts where the triangle is.
    start: f64,
}

/// The tables of the shapes that consist of triangles.
type Shapes<'t> = (Option<&'t Shared<TriangleTable>>, Option<&'t Shared<MeshTable>>);

/// Sets a pair of a ray and a triangle, and gives the t at which the ray starts there.
#[inline(always)]
fn set_pair(
    pairs: &mut TrianglePairs,
    place: usize,
    ray: [DVec3; 2],
    (triangles, meshes): Shapes<'_>,
    &RasterTriangle { primitive, row, .. }: &RasterTriangle,
) -> f64 {
    let of = row as usize;
    match (triangles, meshes) {
        (_, Some(meshes)) if primitive != NO_PRIMITIVE => meshes.row[of].set_pair(pairs, place, ray, primitive),
        (Some(triangles), _) => {
            pairs.set(place, ray, triangles.row[of].corners, triangles.row[of].size);
            0.0
        }
        _ => f64::INFINITY,
    }
}

/// The t of a ray that passes so near an edge that exact arithmetic has to say whether it hits.
#[cold]
fn uncertain_t(
    ray: [DVec3; 2],
    &RasterTriangle { primitive, row, .. }: &RasterTriangle,
    (triangles, meshes): Shapes<'_>,
) -> f64 {
    let of = row as usize;
    match (triangles, meshes) {
        (_, Some(meshes)) if primitive != NO_PRIMITIVE => meshes.row[of].triangle_t(ray, primitive),
        (Some(triangles), _) => triangle_t(ray[0], ray[1], &triangles.row[of]),
        _ => f64::INFINITY,
    }
}

impl RasterViewItem<'_, '_> {
    /// The ray of a row.
    #[inline(always)]
    fn ray(&self, row: usize) -> [DVec3; 2] {
        [self.rays.origin_of(row), self.rays.direction_of(row)]
    }

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
