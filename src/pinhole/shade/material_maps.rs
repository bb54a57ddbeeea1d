//! Maps: metallic and roughness, and emission, from images over uv.

use super::lookup::{image_mean, nearest_texel, transformed};
use super::row_slopes::{RowSlopes, with_mesh_slopes};
use super::texture_point::{UvPointView, UvPointViewItem};
use crate::extract::TexturePoint;
use crate::extract::{
    EmissionMapTable, MaterialTable, MetallicRoughnessTable, NO_TEXTURE, ShapeSpaces, UvImages, UvSlopes,
    emission_map_evidence, filtered_emission_evidence, filtered_roughness_evidence, metallic_roughness_evidence,
};
use crate::intersect::{EmissiveRows, MaterialRows, SurfaceUvs, Surfaces};
use crate::plan::{Column, Shared, Stage, TileSystems, column};
use bevy_ecs::prelude::*;

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
        /// Red; 1 where no image gives it.
        r: f32,
        /// Green.
        g: f32,
        /// Blue.
        b: f32,
    }
}

impl EmissionFactors {
    /// The factor itself, as a colour.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.r[row], self.g[row], self.b[row]]
    }

    /// A row's radiance, multiplied by its factor.
    #[inline(always)]
    pub fn times(&self, row: usize, [r, g, b]: [f32; 3]) -> [f32; 3] {
        [r * self.r[row], g * self.g[row], b * self.b[row]]
    }
}

/// The mean of an image over a pixel's footprint about a point of uv, or its nearest texel.
pub(super) fn looked_up(images: &UvImages, map: usize, uv: TexturePoint) -> [f64; 3] {
    let (size, wrap, pyramid) = (images.size[map], images.wrap[map], &images.pyramid[map]);
    let at = TexturePoint { point: uv.point / size, steps: uv.steps.map(|step| step / size) };
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
        let (r, g, b) = found.slices_mut(surfaces.rows());
        r.fill(1.0);
        g.fill(1.0);
        b.fill(1.0);
        for (&row, &of) in list.row.iter().zip(&list.emissive) {
            let (row, map) = (row as usize, maps.of_emissive[of as usize]);
            if map == NO_TEXTURE {
                continue;
            }
            let factor = looked_up(&maps.images, map as usize, at.uv_point(&spaces, &slopes, row));
            [r[row], g[row], b[row]] = factor.map(|part| part.max(0.0) as f32);
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
