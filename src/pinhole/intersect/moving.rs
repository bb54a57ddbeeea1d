use super::surface::{Surface, SurfaceSides, Surfaces};
use super::{HitColumn, HitPrimitives, Hits, NO_SHAPE, RayColumn};
use crate::extract::{MovingTable, ShapeTable, moving_evidence, primitive_evidence};
use crate::plan::{Column, Shared, Stage, TileSystems};
use crate::rays::{RayTimes, WorldRays};
use crate::shapes::{ClosestHits, LANES, RayBlock, RayHit, RaySlices, ShapeKind, vector};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::DVec3;
use multiversion::multiversion;

// ANCHOR: at_rest
/// The origin of a ray relative to a moving shape, which at time τ is O − vτ.
///
/// In that frame the shape stays where it was when the shutter opened; t is the same in both frames.
#[inline(always)]
pub fn at_rest(origin: DVec3, velocity: DVec3, time: f64) -> DVec3 {
    origin - velocity * time
}
// ANCHOR_END: at_rest

/// Intersects any column of rays, each at its own time, with all moving shapes and keeps the closest hits.
pub fn intersect_moving<R: RayColumn, H: HitColumn>(
    moving: Res<Shared<MovingTable>>,
    mut tiles: Query<(&R, &RayTimes, &mut H, Option<&mut HitPrimitives>)>,
) {
    for (rays, times, mut hits, mut primitives) in &mut tiles {
        let hits = hits.closest_hits();
        // Those of the tile's own rays; any hit blocks a shadow ray.
        let primitives = primitives.as_mut().filter(|_| !hits.any);
        let primitive = primitives.map(|primitives| primitives.slices_mut(hits.t.len()));
        let hits = ClosestHits { primitive, ..hits };
        moving_rows(rays.ray_components(), (&times.time, rays.path_component()), &moving, hits);
    }
}

/// Tests one shape at a time against all rays, so that the arithmetic is vectorised over rays.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn moving_rows(
    rays: RaySlices<'_>,
    (times_of_paths, path): (&[f64], Option<&[u32]>),
    moving: &MovingTable,
    ClosestHits { t, shape, mut primitive, any }: ClosestHits<'_>,
) {
    let rows = t.len();
    let mut start = 0;
    while start < rows {
        let end = rows.min(start + LANES);
        let block = RayBlock::of(rays, start, end);
        let mut times = [0.0; LANES];
        for (lane, row) in (start..end).enumerate() {
            times[lane] = times_of_paths[path.map_or(row, |path| path[row] as usize)];
        }
        let (t, shape, inverse) = (&mut t[start..end], &mut shape[start..end], block.inverses());
        for ((body, velocity), &number) in moving.body.iter().zip(&moving.velocity).zip(&moving.shape) {
            let mut own = RayBlock { o: block.o, d: block.d };
            for (lane, &time) in times.iter().enumerate() {
                let origin = at_rest(vector(&own.o, lane), *velocity, time);
                (own.o[0][lane], own.o[1][lane], own.o[2][lane]) = origin.into();
            }
            let primitive = primitive.as_deref_mut().map(|primitive| &mut primitive[start..end]);
            body.keep_closest((&own, &inverse), number, ClosestHits { t: &mut *t, shape: &mut *shape, primitive, any });
        }
        start = end;
    }
}

/// What is read to describe the surfaces of moving shapes, and what is filled.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct MovingSurfaceView {
    rays: &'static WorldRays,
    times: &'static RayTimes,
    hits: &'static Hits,
    primitives: Option<&'static HitPrimitives>,
    surfaces: &'static mut Surfaces,
    sides: Option<&'static mut SurfaceSides>,
}

/// Fills the surface of every row that hit a moving shape, at the shape's position at the ray's time.
pub fn fill_moving_surfaces(
    moving: Res<Shared<MovingTable>>,
    shapes: Res<Shared<ShapeTable>>,
    mut tiles: Query<MovingSurfaceView>,
) {
    let moves = |shape: u32| shape != NO_SHAPE && shapes.kind[shape as usize] == ShapeKind::Moving;
    for MovingSurfaceViewItem { rays, times, hits, primitives, mut surfaces, mut sides } in &mut tiles {
        for row in (0..hits.rows()).filter(|&row| moves(hits.shape[row])) {
            let shape = hits.shape[row] as usize;
            let mover = shapes.row[shape] as usize;
            let displacement = moving.velocity[mover] * times.time[row];
            let (origin, direction) = (rays.origin_of(row) - displacement, rays.direction_of(row));
            let primitive = primitives.map_or(0, |primitives| primitives.primitive[row]);
            let hit = RayHit { origin, direction, t: hits.t[row], primitive, displacement };
            let mut surface = moving.body[mover].surface(&hit);
            surface.point += displacement;
            surfaces.set(row, Surface::of(surface, shapes.material[shape]));
            if let Some(sides) = &mut sides {
                sides.outside[row] = u32::from(surface.outside);
            }
        }
    }
}

/// The stage that intersects camera rays.
pub fn moving_stage() -> Stage {
    Stage::new("Intersect moving shapes", TileSystems::Intersect, intersect_moving::<WorldRays, Hits>)
        .when(moving_evidence)
}

/// The stage that fills surfaces.
pub fn moving_surface_stage() -> Stage {
    Stage::new("Compute surfaces: moving shapes", TileSystems::Surface, fill_moving_surfaces)
        .reads_where::<HitPrimitives>(primitive_evidence)
        .when(moving_evidence)
}
