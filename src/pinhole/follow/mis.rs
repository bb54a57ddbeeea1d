use super::{MultipleScatteringTable, RoughMetals, frame_of, power_heuristic};
use crate::extract::{
    MaterialKind, MaterialTable, MetalTable, area_light_evidence, environment_light_evidence, material_kind_evidence,
    metal_evidence, mis_evidence, multiple_scattering_evidence,
};
use crate::intersect::{ShadingNormals, Surfaces};
use crate::plan::{Census, Column, Evidence, Shared, Stage, StageKind, TileSystems};
use crate::rays::WorldRays;
use crate::scene::Matte;
use crate::shade::{LightPdfs, LightRays};
use bevy_ecs::prelude::*;
use glam::DVec3;
use std::f64::consts::FRAC_1_PI;

// ANCHOR: mis_matte
/// Weights every light sample against BSDF sampling at matte surfaces, whose pdf is cos θ / π.
pub fn mis_matte(
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&Surfaces, Option<&ShadingNormals>, &LightPdfs, &mut LightRays)>,
) {
    for (surfaces, shading, pdfs, mut rays) in &mut tiles {
        for ray in 0..rays.rows() {
            let (row, by_light) = (rays.path[ray] as usize, pdfs.pdf[ray]);
            let surface = surfaces.get(row);
            if by_light == 0.0 || materials.kind[surface.material as usize] != MaterialKind::Matte {
                continue;
            }
            let normal = shading.map_or_else(|| surface.normal.as_dvec3(), |shading| shading.get(row));
            let by_bsdf = rays.direction_of(ray).dot(normal).max(0.0) * FRAC_1_PI;
            rays.weight_by(ray, power_heuristic(by_light, by_bsdf));
        }
    }
}
// ANCHOR_END: mis_matte

/// Evidence that a light can be found by BSDF sampling too.
fn light_rays_evidence(scene: &Census<'_>) -> Evidence {
    area_light_evidence(scene).or(environment_light_evidence(scene))
}

/// The stage that runs [`mis_matte`].
pub fn mis_matte_stage() -> Stage {
    Stage::new("Compute MIS weights: matte", TileSystems::MisWeights, mis_matte).kind(StageKind::Alternative).when(
        |scene| {
            light_rays_evidence(scene)
                .and(|| mis_evidence(scene))
                .and(|| material_kind_evidence::<Matte>(scene, "matte surface"))
        },
    )
}

/// Weights the light samples for which there is a pdf of BSDF sampling.
///
/// `pdf` gets the row, its material, and the directions to light and eye in the frame of the shading normal.
#[inline(always)]
pub(super) fn weight_by_bsdf(
    rays: &mut LightRays,
    (eye, surfaces, shading, pdfs): (&WorldRays, &Surfaces, Option<&ShadingNormals>, &LightPdfs),
    pdf: impl Fn(usize, usize, DVec3, DVec3) -> Option<f64>,
) {
    for ray in 0..rays.rows() {
        let (row, by_light) = (rays.path[ray] as usize, pdfs.pdf[ray]);
        if by_light == 0.0 {
            continue;
        }
        let surface = surfaces.get(row);
        let normal = shading.map_or_else(|| surface.normal.as_dvec3(), |shading| shading.get(row));
        let local_from_world = frame_of(normal).transpose();
        let [to_light, to_eye] =
            [rays.direction_of(ray), -eye.direction_of(row)].map(|direction| local_from_world * direction);
        if let Some(by_bsdf) = pdf(row, surface.material as usize, to_light, to_eye) {
            rays.weight_by(ray, power_heuristic(by_light, by_bsdf));
        }
    }
}

/// Weights every light sample against BSDF sampling at rough metal, by visible microfacet normals.
pub fn mis_metal(
    materials: Res<Shared<MaterialTable>>,
    (metals, several): (Res<Shared<MetalTable>>, Option<Res<Shared<MultipleScatteringTable>>>),
    mut tiles: Query<(&WorldRays, &Surfaces, Option<&ShadingNormals>, &LightPdfs, &mut LightRays)>,
) {
    let rough = RoughMetals { metals: &metals, several: several.as_deref().map(|several| &**several) };
    for (eye, surfaces, shading, pdfs, mut rays) in &mut tiles {
        weight_by_bsdf(&mut rays, (eye, surfaces, shading, pdfs), |_, material, to_light, to_eye| {
            let metal = materials.row[material] as usize;
            (materials.kind[material] == MaterialKind::Metal).then(|| rough.pdf(metal, to_light, to_eye))
        });
    }
}

/// The stage that runs [`mis_metal`].
pub fn mis_metal_stage() -> Stage {
    Stage::new("Compute MIS weights: metal", TileSystems::MisWeights, mis_metal)
        .kind(StageKind::Alternative)
        .table_where::<MultipleScatteringTable>(multiple_scattering_evidence)
        .when(|scene| light_rays_evidence(scene).and(|| mis_evidence(scene)).and(|| metal_evidence(scene)))
}
