//! Normal maps: shading normals that are tilted by an image.

use super::lookup::bilinear;
use super::row_slopes::{RowSlopes, with_mesh_slopes};
use crate::extract::{NO_TEXTURE, NormalMapTable, ShapeSpaces, UvSlopes, normal_map_evidence};
use crate::intersect::{
    HitPrimitives, Hits, NO_SHAPE, ShadingNormals, SurfaceSides, SurfaceUvs, Surfaces, vertex_normal_evidence,
};
use crate::material::frame_of;
use crate::plan::{Column, Evidence, Shared, Stage, StageKind, TileSystems};
use crate::rays::WorldRays;
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::{DVec2, DVec3};

// ANCHOR: uv_directions
/// The directions along a surface in which u grows while v stays, and in which v falls while u stays; of any length, and
/// 0 or not finite where there are none.
///
/// `change` gives the change of u and v along an offset.
/// Along two tangents it is a 2 × 2 matrix, whose inverse has these directions as columns, but for their lengths.
#[inline(always)]
pub fn uv_directions(normal: DVec3, change: impl Fn(DVec3) -> DVec3) -> [DVec3; 2] {
    let frame = frame_of(normal);
    let (one, other) = (change(frame.x_axis), change(frame.y_axis));
    let [u, v] = [DVec2::new(one.x, other.x), DVec2::new(one.y, other.y)].map(|row| row / row.abs().max_element());
    let sign = u.perp_dot(v).signum();
    let along = |row: DVec2| sign * (row.y * frame.x_axis - row.x * frame.y_axis);
    [along(v), along(u)]
}
// ANCHOR_END: uv_directions

// ANCHOR: mapped_normal
/// The shading normal that a normal map makes of one, on the same side of the surface.
///
/// `local` is the map's normal: its parts to the right, up, and out of the surface, which is the side of `shading` if the
/// ray arrived from outside.
/// The frame is the shading normal, the direction to the right made perpendicular to it, and the one perpendicular to
/// both that leads up, as in glTF.
#[inline(always)]
pub fn mapped_normal(shading: DVec3, from_outside: bool, [right, up]: [DVec3; 2], local: DVec3) -> DVec3 {
    let outward = if from_outside { shading } else { -shading };
    let tangent = (right - outward.dot(right) * outward).normalize();
    let across = outward.cross(tangent);
    let bitangent = if across.dot(up) < 0.0 { -across } else { across };
    let mapped = (local.x * tangent + local.y * bitangent + local.z * outward).normalize();
    if !mapped.is_finite() {
        // Where u and v have no directions, as at the poles of a sphere.
        shading
    } else if from_outside {
        mapped
    } else {
        -mapped
    }
}
// ANCHOR_END: mapped_normal

/// The hits, and the shading normals that are tilted there.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct NormalMapView {
    rays: &'static WorldRays,
    hits: &'static Hits,
    surfaces: &'static Surfaces,
    uvs: &'static SurfaceUvs,
    sides: &'static SurfaceSides,
    primitives: Option<&'static HitPrimitives>,
    shading: &'static mut ShadingNormals,
}

/// Tilts the shading normals of materials with a normal map.
pub fn map_normals(
    maps: Res<Shared<NormalMapTable>>,
    spaces: Res<Shared<ShapeSpaces>>,
    slopes: RowSlopes<'_>,
    mut tiles: Query<NormalMapView>,
) {
    for NormalMapViewItem { rays, hits, surfaces, uvs, sides, primitives, mut shading } in &mut tiles {
        for row in (0..hits.rows()).filter(|&row| hits.shape[row] != NO_SHAPE) {
            // A shape that only emits has no material.
            let map = maps.of_material.get(surfaces.material[row] as usize).copied().unwrap_or(NO_TEXTURE);
            if map == NO_TEXTURE {
                continue;
            }
            let (map, shape) = (map as usize, hits.shape[row] as usize);
            let mut at = DVec2::new(uvs.u[row], uvs.v[row]) / maps.size[map];
            if let Some((matrix, offset)) = maps.transform[map] {
                at = matrix * at + offset;
            }
            let [x, y, z] = bilinear(&maps.image[map].texels, at, maps.wrap[map]).map(|part| 2.0 * part - 1.0);
            let local = DVec3::new(x * maps.scale[map], y * maps.scale[map], z);
            if local.x == 0.0 && local.y == 0.0 {
                continue;
            }
            let normal = surfaces.get(row).normal.as_dvec3();
            let shape_from_world = spaces.shape_from_world[shape];
            let own = shape_from_world * (rays.point_at(row, hits.t[row]) - spaces.origin[shape]);
            let Some(slope) = slopes.get(shape, primitives, row) else { continue };
            let change = |step: DVec3| slope.step(own, normal, step, shape_from_world * step);
            let directions = uv_directions(normal, change);
            let mapped = mapped_normal(shading.get(row), sides.outside[row] == 1, directions, local);
            shading.set(row, mapped);
        }
    }
}

/// Makes every shading normal the geometric one, where no vertex normals are interpolated.
pub fn copy_normals(mut tiles: Query<(&Surfaces, &mut ShadingNormals)>) {
    for (surfaces, mut shading) in &mut tiles {
        let (nx, ny, nz) = shading.slices_mut(surfaces.rows());
        nx.copy_from_slice(&surfaces.nx);
        ny.copy_from_slice(&surfaces.ny);
        nz.copy_from_slice(&surfaces.nz);
    }
}

/// The stage that runs [`map_normals`].
pub fn normal_map_stage() -> Stage {
    with_mesh_slopes(Stage::new("Evaluate textures: normal maps", TileSystems::Texture, map_normals))
        .table_where::<UvSlopes>(normal_map_evidence)
        .when(normal_map_evidence)
}

/// The stage that runs [`copy_normals`].
pub fn copy_normals_stage() -> Stage {
    Stage::new("Copy geometric normals", TileSystems::Normal, copy_normals).kind(StageKind::Alternative).when(|scene| {
        let interpolated = vertex_normal_evidence(scene);
        normal_map_evidence(scene).and(|| Evidence { needed: !interpolated.needed, ..interpolated })
    })
}
