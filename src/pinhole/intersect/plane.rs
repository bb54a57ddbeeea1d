use super::rows::PlaneRows;
use super::surface::{Surface, SurfaceUvs, offset_bound};
use super::view::{SurfaceView, SurfaceViewItem};
use super::{HitColumn, Hits, RayColumn, RaySlices};
use crate::extract::{PlaneTable, ShapeTable, UvSpaceTable};
use crate::plan::{Census, Evidence, Shared, Stage, TileSystems};
use crate::rays::WorldRays;
use crate::scene::Plane;
use bevy_ecs::prelude::*;
use glam::DVec3;
use multiversion::multiversion;

// ANCHOR: plane_t
/// The t > 0 at which O + tR intersects the plane n·x = k, or infinity.
///
/// A ray parallel to the plane divides by 0; the result is infinite or NaN, and neither passes the test.
#[inline(always)]
pub fn plane_t(origin: DVec3, direction: DVec3, normal: DVec3, offset: f64) -> f64 {
    let t = (offset - normal.dot(origin)) / normal.dot(direction);
    if t > 0.0 && t < f64::INFINITY { t } else { f64::INFINITY }
}
// ANCHOR_END: plane_t

/// Intersects any column of rays with all planes and keeps the closest hits.
pub fn intersect_planes<R: RayColumn, H: HitColumn>(planes: Res<Shared<PlaneTable>>, mut tiles: Query<(&R, &mut H)>) {
    for (rays, mut hits) in &mut tiles {
        let (t, shape) = hits.hit_components();
        plane_rows(rays.ray_components(), &planes, t, shape);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn plane_rows(rays: RaySlices<'_>, planes: &PlaneTable, t: &mut [f64], shape: &mut [u32]) {
    let rows = t.len();
    let [ox, oy, oz] = rays.origin.map(|component| &component[..rows]);
    let [dx, dy, dz] = rays.direction.map(|component| &component[..rows]);
    let shape = &mut shape[..rows];
    for plane in 0..planes.normal.len() {
        let (normal, offset, number) = (planes.normal[plane], planes.offset[plane], planes.shape[plane]);
        for row in 0..rows {
            let origin = DVec3::new(f64::from(ox[row]), f64::from(oy[row]), f64::from(oz[row]));
            let direction = DVec3::new(f64::from(dx[row]), f64::from(dy[row]), f64::from(dz[row]));
            let found = plane_t(origin, direction, normal, offset);
            let closer = (found < t[row]) | ((found == t[row]) & (number < shape[row]) & (found < f64::INFINITY));
            t[row] = if closer { found } else { t[row] };
            shape[row] = if closer { number } else { shape[row] };
        }
    }
}

/// Fills the surface of every row that hit a plane.
pub fn fill_plane_surfaces(
    planes: Res<Shared<PlaneTable>>,
    shapes: Res<Shared<ShapeTable>>,
    uv_spaces: Option<Res<Shared<UvSpaceTable>>>,
    mut tiles: Query<SurfaceView<PlaneRows>>,
) {
    for SurfaceViewItem { rays, hits, list, mut surfaces, uvs, sides } in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let shape = hits.shape[row] as usize;
            let plane = shapes.row[shape] as usize;
            let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
            let point = origin + hits.t[row] * direction;
            let bound = offset_bound(point, origin, planes.offset[plane].abs());
            surfaces.set(row, Surface::facing(direction, point, planes.normal[plane], bound, shapes.material[shape]));
        }
        if let Some(mut sides) = sides {
            for &row in &list.row {
                let row = row as usize;
                let plane = shapes.row[hits.shape[row] as usize] as usize;
                sides.outside[row] = u32::from(planes.normal[plane].dot(rays.direction_of(row)) <= 0.0);
            }
        }
        if let (Some(mut uvs), Some(spaces)) = (uvs, &uv_spaces) {
            for &row in &list.row {
                let row = row as usize;
                let at = spaces.point(hits.shape[row] as usize, rays.point_at(row, hits.t[row]));
                uvs.set(row, [at.x, at.y]);
            }
        }
    }
}

/// The stage that intersects camera rays.
pub fn plane_stage() -> Stage {
    Stage::new("Intersect planes", TileSystems::Intersect, intersect_planes::<WorldRays, Hits>).when(plane_evidence)
}

/// The stage that fills surfaces.
pub fn plane_surface_stage() -> Stage {
    Stage::new("Compute surfaces: planes", TileSystems::Surface, fill_plane_surfaces)
        .table_with::<UvSpaceTable, SurfaceUvs>()
        .when(plane_evidence)
}

/// Evidence that the scene contains a plane.
pub fn plane_evidence(scene: &Census<'_>) -> Evidence {
    Evidence::of::<Plane>(scene, "plane")
}
