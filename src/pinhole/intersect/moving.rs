use super::disk::disk_intersection;
use super::double_double::double_double_sphere_t;
use super::double_double_planar::{double_double_disk_t, double_double_rectangle_t};
use super::ray_block::{LANES, RayBlock, keep_closest, vector};
use super::rectangle::rectangle_intersection;
use super::sphere::sphere_intersection;
use super::surface::{Surface, SurfaceSides, Surfaces, l1_norm, offset_bound};
use super::{HitColumn, Hits, NO_SHAPE, RayColumn, RaySlices};
use crate::extract::{Body, MovingTable, ShapeKind, ShapeTable, moving_evidence};
use crate::plan::{Column, Shared, Stage, TileSystems};
use crate::rays::{RayTimes, WorldRays};
use bevy_ecs::prelude::*;
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
    mut tiles: Query<(&R, &RayTimes, &mut H)>,
) {
    for (rays, times, mut hits) in &mut tiles {
        let (t, shape) = hits.hit_components();
        moving_rows(rays.ray_components(), (&times.time, rays.path_component()), &moving, t, shape);
    }
}

/// Tests one shape at a time against all rays, so that the arithmetic is vectorised over rays.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn moving_rows(
    rays: RaySlices<'_>,
    (times_of_paths, path): (&[f64], Option<&[u32]>),
    moving: &MovingTable,
    t: &mut [f64],
    shape: &mut [u32],
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
        let (t, shape) = (&mut t[start..end], &mut shape[start..end]);
        for ((body, velocity), &number) in moving.body.iter().zip(&moving.velocity).zip(&moving.shape) {
            let mut own = RayBlock { o: block.o, d: block.d, inverse: block.inverse };
            for (lane, &time) in times.iter().enumerate() {
                let origin = at_rest(vector(&own.o, lane), *velocity, time);
                (own.o[0][lane], own.o[1][lane], own.o[2][lane]) = origin.into();
            }
            match body {
                &Body::Sphere { centre, radius } => keep_closest(
                    &own,
                    |origin, direction| sphere_intersection(centre - origin, direction, radius),
                    |origin, direction| double_double_sphere_t(origin, direction, centre, radius),
                    number,
                    t,
                    shape,
                ),
                Body::Disk(planar) => keep_closest(
                    &own,
                    |origin, direction| disk_intersection(origin, direction, planar),
                    |origin, direction| double_double_disk_t(origin, direction, planar),
                    number,
                    t,
                    shape,
                ),
                Body::Rectangle(planar) => keep_closest(
                    &own,
                    |origin, direction| rectangle_intersection(origin, direction, planar),
                    |origin, direction| double_double_rectangle_t(origin, direction, planar),
                    number,
                    t,
                    shape,
                ),
            }
        }
        start = end;
    }
}

/// Fills the surface of every row that hit a moving shape, at the shape's position at the ray's time.
pub fn fill_moving_surfaces(
    moving: Res<Shared<MovingTable>>,
    shapes: Res<Shared<ShapeTable>>,
    mut tiles: Query<(&WorldRays, &RayTimes, &Hits, &mut Surfaces, Option<&mut SurfaceSides>)>,
) {
    let moves = |shape: u32| shape != NO_SHAPE && shapes.kind[shape as usize] == ShapeKind::Moving;
    for (rays, times, hits, mut surfaces, mut sides) in &mut tiles {
        for row in (0..hits.rows()).filter(|&row| moves(hits.shape[row])) {
            let shape = hits.shape[row] as usize;
            let mover = shapes.row[shape] as usize;
            let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
            let displacement = moving.velocity[mover] * times.time[row];
            let point = origin + hits.t[row] * direction;
            let (normal, size) = match &moving.body[mover] {
                Body::Sphere { centre, radius } => {
                    ((point - displacement - *centre).try_normalize().unwrap_or(-direction), l1_norm(*centre) + radius)
                }
                Body::Disk(planar) | Body::Rectangle(planar) => (planar.normal, l1_norm(planar.centre)),
            };
            let bound = offset_bound(point, origin, size + l1_norm(displacement));
            let surface = Surface::facing(direction, point, normal, bound, shapes.material[shape]);
            surfaces.set(row, surface);
            if let Some(sides) = &mut sides {
                sides.outside[row] = u32::from(surface.normal.as_dvec3().dot(normal) >= 0.0);
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
    Stage::new("Compute surfaces: moving shapes", TileSystems::Surface, fill_moving_surfaces).when(moving_evidence)
}
