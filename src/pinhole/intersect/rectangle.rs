use super::double_double_planar::double_double_rectangle_t;
use super::planar::{crossing, fill_planar_surfaces};
use super::ray_block::{Intersection, LANES, RayBlock, keep_closest};
use super::rows::RectangleRows;
use super::view::{SurfaceView, SurfaceViewItem};
use super::{HitColumn, Hits, RayColumn, RaySlices};
use crate::extract::{Planar, RectangleTable, ShapeTable, moves_while_open};
use crate::plan::{Census, Evidence, Shared, Stage, TileSystems};
use crate::rays::WorldRays;
use crate::scene::Rectangle;
use bevy_ecs::prelude::*;
use glam::DVec3;
use multiversion::multiversion;

/// Intersects O + tR with a rectangle, in f64: at the rectangle's plane, if both coordinates there are in [−1, 1].
#[inline(always)]
pub fn rectangle_intersection(origin: DVec3, direction: DVec3, planar: &Planar) -> Intersection {
    let crossing = crossing(origin, direction, planar);
    let [x, z] = crossing.at.map(f64::abs);
    let farther = if x > z { x } else { z };
    let at_the_edge = (farther - 1.0).abs() <= crossing.error;
    let hits = (x <= 1.0) & (z <= 1.0) & (crossing.t > 0.0) & !crossing.surely_not;
    Intersection {
        t: if hits { crossing.t } else { f64::INFINITY },
        uncertain: !crossing.surely_not & (!crossing.sure | at_the_edge),
    }
}

/// The t > 0 at which O + tR hits a rectangle, or infinity; uncertain cases are decided in double-double.
#[inline(always)]
pub fn rectangle_t(origin: DVec3, direction: DVec3, planar: &Planar) -> f64 {
    let intersection = rectangle_intersection(origin, direction, planar);
    if intersection.uncertain { double_double_rectangle_t(origin, direction, planar) } else { intersection.t }
}

/// Intersects any column of rays with all rectangles and keeps the closest hits.
pub fn intersect_rectangles<R: RayColumn, H: HitColumn>(
    rectangles: Res<Shared<RectangleTable>>,
    mut tiles: Query<(&R, &mut H)>,
) {
    for (rays, mut hits) in &mut tiles {
        let (t, shape) = hits.hit_components();
        rectangle_rows(rays.ray_components(), &rectangles, t, shape);
    }
}

/// Tests one rectangle at a time against all rays, so that the arithmetic is vectorised over rays.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn rectangle_rows(rays: RaySlices<'_>, rectangles: &RectangleTable, t: &mut [f64], shape: &mut [u32]) {
    let rows = t.len();
    let mut start = 0;
    while start < rows {
        let end = rows.min(start + LANES);
        let block = RayBlock::of(rays, start, end);
        for (planar, &number) in rectangles.planar.iter().zip(&rectangles.shape) {
            let intersection = |origin, direction| rectangle_intersection(origin, direction, planar);
            let double_double = |origin, direction| double_double_rectangle_t(origin, direction, planar);
            keep_closest(&block, intersection, double_double, number, &mut t[start..end], &mut shape[start..end]);
        }
        start = end;
    }
}

/// Fills the surface of every row that hit a rectangle.
pub fn fill_rectangle_surfaces(
    rectangles: Res<Shared<RectangleTable>>,
    shapes: Res<Shared<ShapeTable>>,
    mut tiles: Query<SurfaceView<RectangleRows>>,
) {
    for SurfaceViewItem { rays, hits, list, mut surfaces, mut uvs, mut sides } in &mut tiles {
        let planar_of = |shape: u32| &rectangles.planar[shapes.row[shape as usize] as usize];
        let beside = (uvs.as_deref_mut(), sides.as_deref_mut());
        fill_planar_surfaces(planar_of, &shapes, &list.row, (rays, hits), &mut surfaces, beside);
    }
}

/// The stage that intersects camera rays.
pub fn rectangle_stage() -> Stage {
    Stage::new("Intersect rectangles", TileSystems::Intersect, intersect_rectangles::<WorldRays, Hits>)
        .when(rectangle_evidence)
}

/// The stage that fills surfaces.
pub fn rectangle_surface_stage() -> Stage {
    Stage::new("Compute surfaces: rectangles", TileSystems::Surface, fill_rectangle_surfaces).when(rectangle_evidence)
}

/// Evidence that the scene contains a rectangle.
pub fn rectangle_evidence(scene: &Census<'_>) -> Evidence {
    let moves = moves_while_open(scene);
    Evidence::of_kind::<With<Rectangle>>(scene, "rectangle", |rectangle| !moves(rectangle))
}
