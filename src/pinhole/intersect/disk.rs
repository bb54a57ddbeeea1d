use super::double_double_planar::double_double_disk_t;
use super::planar::{crossing, fill_planar_surfaces};
use super::ray_block::{Intersection, LANES, RayBlock, keep_closest};
use super::rows::DiskRows;
use super::view::{SurfaceView, SurfaceViewItem};
use super::{HitColumn, Hits, RayColumn, RaySlices};
use crate::extract::{DiskTable, Planar, ShapeTable, moves_while_open};
use crate::plan::{Census, Evidence, Shared, Stage, TileSystems};
use crate::rays::WorldRays;
use crate::scene::Disk;
use bevy_ecs::prelude::*;
use glam::DVec3;
use multiversion::multiversion;

// ANCHOR: disk_intersection
/// Intersects O + tR with a disk, in f64: at the disk's plane, if the squares of the coordinates there sum to at most
/// 1.
///
/// If rounding moved the point p by at most e along each axis, |p|² is off by at most 2√2|p|e + 2e², and 2|p| ≤ 1 +
/// |p|².
#[inline(always)]
pub fn disk_intersection(origin: DVec3, direction: DVec3, planar: &Planar) -> Intersection {
    let crossing = crossing(origin, direction, planar);
    let [x, z] = crossing.at;
    let square = x * x + z * z;
    let slack = 3.0 * crossing.error * (1.0 + square + crossing.error);
    let at_the_edge = (square - 1.0).abs() <= slack;
    let hits = (square <= 1.0) & (crossing.t > 0.0) & !crossing.surely_not;
    Intersection {
        t: if hits { crossing.t } else { f64::INFINITY },
        uncertain: !crossing.surely_not & (!crossing.sure | at_the_edge),
    }
}

/// The t > 0 at which O + tR hits a disk, or infinity; uncertain cases are decided in double-double.
#[inline(always)]
pub fn disk_t(origin: DVec3, direction: DVec3, planar: &Planar) -> f64 {
    let intersection = disk_intersection(origin, direction, planar);
    if intersection.uncertain { double_double_disk_t(origin, direction, planar) } else { intersection.t }
}
// ANCHOR_END: disk_intersection

/// Intersects any column of rays with all disks and keeps the closest hits.
pub fn intersect_disks<R: RayColumn, H: HitColumn>(disks: Res<Shared<DiskTable>>, mut tiles: Query<(&R, &mut H)>) {
    for (rays, mut hits) in &mut tiles {
        let (t, shape) = hits.hit_components();
        disk_rows(rays.ray_components(), &disks, t, shape);
    }
}

/// Tests one disk at a time against all rays, so that the arithmetic is vectorised over rays.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn disk_rows(rays: RaySlices<'_>, disks: &DiskTable, t: &mut [f64], shape: &mut [u32]) {
    let rows = t.len();
    let mut start = 0;
    while start < rows {
        let end = rows.min(start + LANES);
        let block = RayBlock::of(rays, start, end);
        for (planar, &number) in disks.planar.iter().zip(&disks.shape) {
            let intersection = |origin, direction| disk_intersection(origin, direction, planar);
            let double_double = |origin, direction| double_double_disk_t(origin, direction, planar);
            keep_closest(&block, intersection, double_double, number, &mut t[start..end], &mut shape[start..end]);
        }
        start = end;
    }
}

/// Fills the surface of every row that hit a disk.
pub fn fill_disk_surfaces(
    disks: Res<Shared<DiskTable>>,
    shapes: Res<Shared<ShapeTable>>,
    mut tiles: Query<SurfaceView<DiskRows>>,
) {
    for SurfaceViewItem { rays, hits, list, mut surfaces, mut uvs, mut sides } in &mut tiles {
        let planar_of = |shape: u32| &disks.planar[shapes.row[shape as usize] as usize];
        let beside = (uvs.as_deref_mut(), sides.as_deref_mut());
        fill_planar_surfaces(planar_of, &shapes, &list.row, (rays, hits), &mut surfaces, beside);
    }
}

/// The stage that intersects camera rays.
pub fn disk_stage() -> Stage {
    Stage::new("Intersect disks", TileSystems::Intersect, intersect_disks::<WorldRays, Hits>).when(disk_evidence)
}

/// The stage that fills surfaces.
pub fn disk_surface_stage() -> Stage {
    Stage::new("Compute surfaces: disks", TileSystems::Surface, fill_disk_surfaces).when(disk_evidence)
}

/// Evidence that the scene contains a disk.
pub fn disk_evidence(scene: &Census<'_>) -> Evidence {
    let moves = moves_while_open(scene);
    Evidence::of_kind::<With<Disk>>(scene, "disk", |disk| !moves(disk))
}
