use super::view::{BsdfView, BsdfViewItem};
use super::{Highlight, Lobe, Scattered, ScatteredRay, frame_of, power_heuristic};
use crate::extract::{
    BlinnPhongTable, MaterialTable, PhongTable, SamplingTable, area_light_evidence, environment_light_evidence,
    material_kind_evidence, mis_evidence, needed_if,
};
use crate::intersect::{MaterialRows, ShadingNormals, Surfaces, offset_origin};
use crate::plan::{Census, Column, Evidence, Shared, Stage, StageKind, TileSystems};
use crate::rays::{DrawsView, WorldRays, draws_of_one, draws_of_two};
use crate::sample::Purpose;
use crate::scene::{BlinnPhong, Integrator, Phong};
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
            let surface = surfaces.get(row);
            let own = surface.normal.as_dvec3();
            let world_from_local = frame_of(shading.map_or(own, |normals| normals.get(row)));
            let to_eye = world_from_local.transpose() * -rays.direction_of(row);
            let material = surface.material as usize;
            let colour = colours.map_or_else(|| materials.colour[material], |colours| colours.get(row));
            let surface_material = Highlight::new(&**lobes, materials.row[material] as usize, colour);
            let Some((to_light, pdf, weights)) = surface_material.sample(to_eye, points[number], choices[number])
            else {
                return ScatteredRay::default();
            };
            let direction = world_from_local * to_light;
            let throughput = if direction.dot(own) > 0.0 { paths.throughput(row) } else { [0.0; 3] };
            ScatteredRay {
                origin: offset_origin(surface.position, surface.normal, surface.bound),
                direction,
                throughput: [0, 1, 2].map(|part| throughput[part] * weights[part]),
                pdf,
            }
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
        for ray in 0..rays.rows() {
            let (row, by_light) = (rays.path[ray] as usize, pdfs.pdf[ray]);
            let surface = surfaces.get(row);
            let material = surface.material as usize;
            if by_light == 0.0 || materials.kind[material] != L::KIND {
                continue;
            }
            let normal = shading.map_or_else(|| surface.normal.as_dvec3(), |shading| shading.get(row));
            let local_from_world = frame_of(normal).transpose();
            let [to_light, to_eye] =
                [rays.direction_of(ray), -eye.direction_of(row)].map(|direction| local_from_world * direction);
            let colour = colours.map_or_else(|| materials.colour[material], |colours| colours.get(row));
            let by_bsdf = Highlight::new(&**lobes, materials.row[material] as usize, colour).pdf(to_light, to_eye);
            rays.weight_by(ray, power_heuristic(by_light, by_bsdf));
        }
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
    surfaces.and(|| needed_if(scene, |integrator| matches!(integrator, Integrator::Path { .. })))
}

fn weighted(scene: &Census<'_>, surfaces: Evidence) -> Evidence {
    surfaces.and(|| area_light_evidence(scene).or(environment_light_evidence(scene))).and(|| mis_evidence(scene))
}
