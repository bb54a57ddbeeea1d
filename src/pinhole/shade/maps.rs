//! Textures of other things than colours: metallic and roughness, emission, normals.

use super::SurfaceColours;
use super::footprint::{RowSlopes, with_mesh_slopes};
use super::lookup::{bilinear, image_mean, nearest_texel, transformed};
use super::textures::{UvPointView, UvPointViewItem};
use crate::each::Each;
use crate::extract::{
    EmissionMapTable, MaterialTable, MetallicRoughnessTable, NO_TEXTURE, NormalMapTable, ShapeSpaces, TexturePoint,
    UvImages, UvSlopes, emission_map_evidence, filtered_emission_evidence, filtered_roughness_evidence,
    metallic_roughness_evidence, normal_map_evidence,
};
use crate::intersect::{
    EmissiveRows, HitPrimitives, Hits, MaterialRows, NO_SHAPE, ShadingNormals, SurfaceSides, SurfaceUvs, Surfaces,
    vertex_normal_evidence,
};
use crate::material::{Parameters, frame_of};
use crate::plan::{Column, Evidence, Shared, Stage, StageKind, TileSystems, VectorRowsMut, column};
use crate::rays::WorldRays;
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::{DVec2, DVec3};

/// The columns that textures write of surfaces' parameters, each where some texture does.
#[derive(QueryData)]
pub struct ParameterColumns {
    /// Colours.
    pub colours: Option<&'static SurfaceColours>,
    /// Metallic and roughness.
    pub metallic_roughness: Option<&'static MetallicRoughness>,
}

impl ParameterColumnsItem<'_, '_> {
    /// The parameters of a row's surface: a column's, or the material's own where there is no such column.
    #[inline(always)]
    pub fn get(&self, materials: &MaterialTable, row: usize, material: usize) -> Parameters {
        let own = &materials.parameters[material];
        let [metallic, roughness] =
            self.metallic_roughness.map_or([own.metallic, own.roughness], |column| column.get(row));
        Parameters { colour: self.colours.map_or(own.colour, |column| column.rgb(row)), metallic, roughness }
    }
}

// Maps: metallic and roughness, and emission, from images over uv.

column! {
    /// The metallic and the roughness of each surface; exists where an image gives them to any.
    pub struct MetallicRoughness("metallic roughness", "surface", "1", Ray) {
        /// The metallic, from 0 to 1.
        metallic: f64,
        /// The perceived roughness, from 0 to 1.
        roughness: f64,
    }
}

impl MetallicRoughness {
    /// Roughness as green and metallic as blue, as in the image.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [0.0, self.roughness[row] as f32, self.metallic[row] as f32]
    }

    /// The metallic and the roughness of a row.
    #[inline(always)]
    pub fn get(&self, row: usize) -> [f64; 2] {
        [self.metallic[row], self.roughness[row]]
    }
}

column! {
    /// What images make of each surface's emission: a factor of its radiance; exists only where there is such an image.
    pub struct EmissionFactors("emission factor", "surface", "linear Rec. 709", Ray) {
        /// Red, green and blue; 1 where no image gives them.
        rgb: [f32; 3] as [r, g, b],
    }
}

impl EmissionFactors {
    /// The factor itself, as a colour.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.rgb(row)
    }

    /// A row's radiance, multiplied by its factor.
    #[inline(always)]
    pub fn times(&self, row: usize, [r, g, b]: [f32; 3]) -> [f32; 3] {
        let factor = self.rgb(row);
        [r * factor[0], g * factor[1], b * factor[2]]
    }
}

/// The mean of an image over a pixel's footprint about a point of uv, or its nearest texel.
pub(super) fn looked_up(images: &UvImages, map: usize, uv: TexturePoint) -> [f64; 3] {
    let (size, wrap, pyramid) = (images.size[map], images.wrap[map], &images.pyramid[map]);
    let at = TexturePoint { point: uv.point / size, steps: uv.steps.each(|step| step / size) };
    let at = transformed(at, &images.transform[map]);
    if images.filter[map] {
        image_mean(pyramid, &at, wrap)
    } else {
        nearest_texel(&pyramid.levels[0], at.point.truncate(), wrap)
    }
}

/// Looks up metallic and roughness at every surface whose material has an image of them; elsewhere they are the material's.
pub fn evaluate_metallic_roughness(
    (maps, materials): (Res<Shared<MetallicRoughnessTable>>, Res<Shared<MaterialTable>>),
    spaces: Res<Shared<ShapeSpaces>>,
    slopes: RowSlopes<'_>,
    mut tiles: Query<(&Surfaces, &MaterialRows, UvPointView, &mut MetallicRoughness)>,
) {
    for (surfaces, list, at, mut found) in &mut tiles {
        let at: UvPointViewItem<'_, '_> = at;
        let (metallic, roughness) = found.slices_mut(surfaces.rows());
        metallic.fill(0.0);
        roughness.fill(0.0);
        for &row in &list.row {
            let row = row as usize;
            let material = surfaces.material[row] as usize;
            let map = maps.of_material[material];
            if map == NO_TEXTURE {
                (metallic[row], roughness[row]) =
                    (materials.parameters[material].metallic, materials.parameters[material].roughness);
                continue;
            }
            let [_, green, blue] = looked_up(&maps.images, map as usize, at.uv_point(&spaces, &slopes, row));
            metallic[row] = materials.parameters[material].metallic * blue.clamp(0.0, 1.0);
            roughness[row] = materials.parameters[material].roughness * green.clamp(0.0, 1.0);
        }
    }
}

/// Looks up the factor of the emission of every surface that has an image of it.
pub fn evaluate_emission(
    maps: Res<Shared<EmissionMapTable>>,
    spaces: Res<Shared<ShapeSpaces>>,
    slopes: RowSlopes<'_>,
    mut tiles: Query<(&Surfaces, &EmissiveRows, UvPointView, &mut EmissionFactors)>,
) {
    for (surfaces, list, at, mut found) in &mut tiles {
        let at: UvPointViewItem<'_, '_> = at;
        let mut factors = found.slices_mut(surfaces.rows());
        factors.set_all([1.0; 3]);
        for (&row, &of) in list.row.iter().zip(&list.emissive) {
            let (row, map) = (row as usize, maps.of_emissive[of as usize]);
            if map == NO_TEXTURE {
                continue;
            }
            let factor = looked_up(&maps.images, map as usize, at.uv_point(&spaces, &slopes, row));
            factors.put(row, factor.each(|part| part.max(0.0) as f32));
        }
    }
}

/// The stage that runs [`evaluate_metallic_roughness`].
pub fn metallic_roughness_stage() -> Stage {
    let name = "Evaluate textures: roughness";
    with_mesh_slopes(Stage::new(name, TileSystems::Texture, evaluate_metallic_roughness))
        .reads_where::<SurfaceUvs>(metallic_roughness_evidence)
        .table_where::<UvSlopes>(filtered_roughness_evidence)
        .when(metallic_roughness_evidence)
}

/// The stage that runs [`evaluate_emission`].
pub fn emission_map_stage() -> Stage {
    with_mesh_slopes(Stage::new("Evaluate textures: emission", TileSystems::Texture, evaluate_emission))
        .on_camera_paths()
        .reads_where::<SurfaceUvs>(emission_map_evidence)
        .table_where::<UvSlopes>(filtered_emission_evidence)
        .when(emission_map_evidence)
}

// Normal maps: shading normals that are tilted by an image.

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
    let [u, v] = [DVec2::new(one.x, other.x), DVec2::new(one.y, other.y)].each(|row| row / row.abs().max_element());
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
            let mut at = DVec2::from(uvs.uv(row)) / maps.size[map];
            if let Some((matrix, offset)) = maps.transform[map] {
                at = matrix * at + offset;
            }
            let [x, y, z] = bilinear(&maps.image[map].texels, at, maps.wrap[map]).each(|part| 2.0 * part - 1.0);
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
        shading.normal.clone_from(&surfaces.normal);
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
