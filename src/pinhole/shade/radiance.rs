//! The radiance that a ray carries: cleared, emitted, and shown unlit.

use super::light::light_evidence;
use super::{EmissionFactors, LightPdfs, ShadowHits, ShadowRays, SurfaceColours, TransmissiveRows};
use crate::each::Each;
use crate::extract::{
    EmissiveTable, MaterialTable, emissive_evidence, followed_evidence, light_sampling_evidence, material_evidence,
    occlusion_evidence, one_sided_evidence, traced_evidence, unless_occlusion,
};
use crate::intersect::{EmissiveRows, MaterialRows, ShadingNormals, SurfaceSides, Surfaces, shape_evidence};
use crate::plan::{Census, Column, Evidence, Shared, Stage, StageKind, TileSystems, VectorRowsMut, column};
use crate::rays::{RasterPoints, WorldRays};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;

column! {
    /// The radiance that each ray carries to its origin.
    pub struct Radiance("radiance", "light", "linear Rec. 709", Ray, begun in Start) {
        /// Red, green and blue.
        rgb: [f32; 3] as [r, g, b],
    }
}

impl Radiance {
    /// The values themselves, without the sRGB curve that the picture gets.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.rgb(row)
    }
}

/// Sets the radiance of every row of a tile to zero.
pub fn start_radiance(mut tiles: Query<(&RasterPoints, &mut Radiance)>) {
    for (raster, mut radiance) in &mut tiles {
        radiance.slices_mut(raster.rows()).set_all([0.0; 3]);
    }
}

/// The stage that runs [`start_radiance`].
pub fn start_stage() -> Stage {
    Stage::new("Clear radiance", TileSystems::Start, start_radiance)
        .on_first_bounce()
        .on_camera_paths()
        .when(|_| Evidence::always("light is added to it"))
}

// ANCHOR: add_emission
/// Adds the emission of the surface that a ray hit, on the side where it was hit; radiance does not depend on distance.
pub fn add_emission(
    emissive: Res<Shared<EmissiveTable>>,
    mut tiles: Query<(&EmissiveRows, Option<&SurfaceSides>, Option<&EmissionFactors>, &mut Radiance)>,
) {
    for (list, sides, factors, mut radiance) in &mut tiles {
        for (&row, &of) in list.row.iter().zip(&list.emissive) {
            let (row, emitted) = (row as usize, emissive.radiance[of as usize]);
            if sides.is_some_and(|sides| sides.outside[row] == 0 && emissive.one_sided[of as usize]) {
                continue;
            }
            radiance.rgb.add(row, factors.map_or(emitted, |factors| factors.times(row, emitted)));
        }
    }
}
// ANCHOR_END: add_emission

/// The stage that runs [`add_emission`].
pub fn emissive_stage() -> Stage {
    Stage::new("Add emission", TileSystems::Shade, add_emission)
        .on_camera_paths()
        .kind(StageKind::Alternative)
        .reads_where::<SurfaceSides>(one_sided_evidence)
        .when(|scene| {
            let found = emissive_evidence(scene);
            let follows = followed_evidence(scene).needed;
            let traced = || traced_evidence(scene).needed;
            if found.needed && follows && (light_sampling_evidence(scene).needed || traced()) {
                let reason = "added with its MIS weight".into();
                return Evidence { needed: false, reason, count: 0 };
            }
            let unlit = if found.needed && !follows { ", seen, but not lighting other surfaces" } else { "" };
            unless_occlusion(scene, Evidence { reason: format!("{}{unlit}", found.reason), ..found })
        })
}

// ANCHOR: shade_unlit
/// Sets every row's radiance to the colour of the surface that it hit: the picture of a scene without light.
pub fn shade_unlit(
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&Surfaces, Option<&SurfaceColours>, &MaterialRows, &mut Radiance)>,
) {
    for (surfaces, colours, list, mut radiance) in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let material = surfaces.material[row] as usize;
            let colour = colours.map_or_else(|| materials.parameters[material].colour, |colours| colours.rgb(row));
            radiance.rgb.put(row, colour.each(|part| part as f32));
        }
    }
}
// ANCHOR_END: shade_unlit

/// The stage that runs [`shade_unlit`], the alternative to lighting for scenes without any.
pub fn unlit_stage() -> Stage {
    Stage::new("Show unlit surfaces", TileSystems::Shade, shade_unlit).kind(StageKind::Alternative).when(|scene| {
        let material = shown_evidence(scene);
        let followed = followed_evidence(scene).or(occlusion_evidence(scene));
        let shining = light_evidence(scene).or(emissive_evidence(scene)).or(followed);
        if material.needed { Evidence { needed: !shining.needed, ..shining }.and(|| material) } else { material }
    })
}

/// Evidence that there is a surface to show.
pub fn shown_evidence(scene: &Census<'_>) -> Evidence {
    let shapes = shape_evidence(scene);
    if shapes.needed { material_evidence(scene) } else { shapes }
}

/// What a stage reads to sample lights, and the rays towards them that it appends.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct LightSamplingView {
    /// The surfaces that are lit.
    pub surfaces: &'static Surfaces,
    /// Their shading normals, where they have any.
    pub shading: Option<&'static ShadingNormals>,
    /// The rows whose surfaces scatter light.
    pub list: &'static MaterialRows,
    /// Those that are lit from behind as well.
    pub far: Option<&'static TransmissiveRows>,
    /// Shadow rays, with the irradiance that each brings.
    pub rays: &'static mut ShadowRays,
    /// The probabilities with which they were sampled, where something reads them.
    pub pdfs: Option<&'static mut LightPdfs>,
}

/// What a stage reads to evaluate how direct light is reflected towards the eye, and the radiance that it adds to.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct ReflectionView {
    /// The rays from the eye.
    pub eye: &'static WorldRays,
    /// The surfaces that they hit.
    pub surfaces: &'static Surfaces,
    /// Their shading normals, where they have any.
    pub shading: Option<&'static ShadingNormals>,
    /// Shadow rays, with the irradiance that each brings.
    pub light: &'static ShadowRays,
    /// What they hit; none where nothing casts a shadow.
    pub shadow: Option<&'static ShadowHits>,
    /// The sum.
    pub radiance: &'static mut Radiance,
}
