use super::mis::weight_by_bsdf;
use super::view::{BsdfView, BsdfViewItem};
use super::{Highlight, Lobe, Scattered, ScatteredRay};
use crate::extract::{
    BlinnPhongTable, MaterialTable, PhongTable, SamplingTable, area_light_evidence, environment_light_evidence,
    material_kind_evidence, mis_evidence, needed_if,
};
use crate::intersect::{MaterialRows, ShadingNormals, Surfaces};
use crate::plan::{Census, Evidence, Shared, Stage, StageKind, TileSystems};
use crate::rays::{DrawsView, WorldRays, draws_of_one, draws_of_two};
use crate::sample::Purpose;
use crate::scene::{BlinnPhong, Phong};
use crate::shade::{LightPdfs, LightRays, SurfaceColours};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;

/// Samples the BSDF at every surface whose material has this lobe.
pub fn sample_highlight<L: Lobe>(
    sampling: Res<Shared<SamplingTable>>,
    (materials, lobes): (Res<Shared<MaterialTable>>, Res<Shared<L>>),
    (mut list, mut points, mut choices): (Local<Vec<u32>>, Local<Vec<[f64; 2]>>, Local<Vec<f64>>),
    mut tiles: Query<(BsdfView, DrawsView, Option<&SurfaceColours>, &MaterialRows)>,
) {
    for (BsdfViewItem { rays, paths, surfaces, shading, mut scattered }, draws, colours, rows) in &mut tiles {
        let has_lobe = |row: &u32| materials.kind[surfaces.material[*row as usize] as usize] == L::KIND;
        list.clear();
        list.extend(rows.row.iter().copied().filter(has_lobe));
        let draws = draws.draws(&sampling, Some(paths));
        draws_of_two(&draws, Purpose::Direction, &list, &mut points);
        draws_of_one(&draws, Purpose::MaterialChoice, &list, &mut choices);
        scattered.append(&list, |number, row| {
            ScatteredRay::leaving(row, (rays, paths), (surfaces, shading), |surface, to_eye| {
                let material = surface.material as usize;
                let colour = colours.map_or_else(|| materials.colour[material], |colours| colours.get(row));
                let highlight = Highlight::new(&**lobes, materials.row[material] as usize, colour);
                highlight.sample(to_eye, points[number], choices[number])
            })
        });
    }
}

/// What a stage reads to compute the MIS weights of light samples, and the shadow rays that it weights.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct LightWeightView {
    /// The rays from the eye.
    pub eye: &'static WorldRays,
    /// The surfaces that they hit.
    pub surfaces: &'static Surfaces,
    /// Their shading normals, where they have any.
    pub shading: Option<&'static ShadingNormals>,
    /// Their colours, where textures give them any.
    pub colours: Option<&'static SurfaceColours>,
    /// The pdfs with which the shadow rays were sampled.
    pub pdfs: &'static LightPdfs,
    /// The shadow rays.
    pub rays: &'static mut LightRays,
}

/// Weights every light sample against BSDF sampling at surfaces whose material has this lobe.
pub fn mis_highlight<L: Lobe>(
    (materials, lobes): (Res<Shared<MaterialTable>>, Res<Shared<L>>),
    mut tiles: Query<LightWeightView>,
) {
    for LightWeightViewItem { eye, surfaces, shading, colours, pdfs, mut rays } in &mut tiles {
        weight_by_bsdf(&mut rays, (eye, surfaces, shading, pdfs), |row, material, to_light, to_eye| {
            let colour = colours.map_or_else(|| materials.colour[material], |colours| colours.get(row));
            let highlight = || Highlight::new(&**lobes, materials.row[material] as usize, colour);
            (materials.kind[material] == L::KIND).then(|| highlight().pdf(to_light, to_eye))
        });
    }
}

/// The stage that samples materials with Phong highlights.
pub fn phong_sample_stage() -> Stage {
    sampling(Stage::new("Sample BSDFs: Phong", TileSystems::SampleBsdfs, sample_highlight::<PhongTable>))
        .when(|scene| followed(scene, material_kind_evidence::<Phong>(scene, "Phong surface")))
}

/// The stage that samples materials with Blinn–Phong highlights.
pub fn blinn_phong_sample_stage() -> Stage {
    sampling(Stage::new("Sample BSDFs: Blinn–Phong", TileSystems::SampleBsdfs, sample_highlight::<BlinnPhongTable>))
        .when(|scene| followed(scene, material_kind_evidence::<BlinnPhong>(scene, "Blinn–Phong surface")))
}

fn sampling(stage: Stage) -> Stage {
    stage.kind(StageKind::Estimator).appends::<Scattered>()
}

/// The stage that weights light samples at materials with Phong highlights.
pub fn mis_phong_stage() -> Stage {
    Stage::new("Compute MIS weights: Phong", TileSystems::MisWeights, mis_highlight::<PhongTable>)
        .kind(StageKind::Alternative)
        .when(|scene| weighted(scene, material_kind_evidence::<Phong>(scene, "Phong surface")))
}

/// The stage that weights light samples at materials with Blinn–Phong highlights.
pub fn mis_blinn_phong_stage() -> Stage {
    Stage::new("Compute MIS weights: Blinn–Phong", TileSystems::MisWeights, mis_highlight::<BlinnPhongTable>)
        .kind(StageKind::Alternative)
        .when(|scene| weighted(scene, material_kind_evidence::<BlinnPhong>(scene, "Blinn–Phong surface")))
}

fn followed(scene: &Census<'_>, surfaces: Evidence) -> Evidence {
    surfaces.and(|| needed_if(scene, |integrator| integrator.transport().samples_diffuse))
}

fn weighted(scene: &Census<'_>, surfaces: Evidence) -> Evidence {
    surfaces.and(|| area_light_evidence(scene).or(environment_light_evidence(scene))).and(|| mis_evidence(scene))
}
