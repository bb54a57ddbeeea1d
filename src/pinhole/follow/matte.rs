use super::frame::{cosine_direction, frame_of};
use super::view::{BsdfView, BsdfViewItem};
use super::{Scattered, ScatteredRay};
use crate::extract::{MaterialKind, MaterialTable, SamplingTable, material_kind_evidence, needed_if, traced_evidence};
use crate::intersect::MaterialRows;
use crate::plan::{Census, Evidence, Shared, Stage, StageKind, TileSystems};
use crate::rays::{DrawsView, draws_of_two};
use crate::sample::Purpose;
use crate::scene::Matte;
use crate::shade::SurfaceColours;
use crate::shapes::offset_origin;
use bevy_ecs::prelude::*;
use glam::DVec3;
use std::f64::consts::FRAC_1_PI;

/// The factor between the cosines of incidence by the shading normal and by the geometric normal; 0 from behind.
///
/// A path from a light delivers power by the geometric normal, while a path from the camera counts it by the shading
/// normal (Veach 1997, 5.3.2).
#[inline(always)]
fn falls_by_shading(own: DVec3, shading: DVec3, to_light: DVec3) -> f64 {
    let falls = own.dot(to_light);
    if falls > 0.0 { (shading.dot(to_light) / falls).max(0.0) } else { 0.0 }
}

// ANCHOR: sample_matte
/// Samples a cosine-weighted direction at every matte surface.
///
/// The BRDF colour / π times the cosine, divided by the pdf cosine / π, leaves the colour as weight.
/// A ray from a light leaves by the geometric normal, whatever normal the incident light was counted by.
pub fn sample_matte<const FROM_LIGHT: bool>(
    sampling: Res<Shared<SamplingTable>>,
    materials: Res<Shared<MaterialTable>>,
    mut points: Local<Vec<[f64; 2]>>,
    mut tiles: Query<(BsdfView, DrawsView, Option<&SurfaceColours>, &MaterialRows)>,
) {
    for (BsdfViewItem { rays, paths, surfaces, shading, mut scattered }, draws, colours, list) in &mut tiles {
        let draws = draws.draws(&sampling, Some(paths));
        draws_of_two(&draws, Purpose::Direction, &list.row, &mut points);
        scattered.append(&list.row, |number, row| {
            let surface = surfaces.get(row);
            let true_normal = surface.normal.as_dvec3();
            let by_shading = shading.map_or(true_normal, |normals| normals.get(row));
            let normal = if FROM_LIGHT { true_normal } else { by_shading };
            let local = cosine_direction(points[number]);
            let direction = frame_of(normal) * local;
            let material = surface.material as usize;
            let colour = colours.map_or_else(|| materials.colour[material], |colours| colours.get(row));
            // Other materials of the list are sampled by their own stages.
            let is_matte = materials.kind[material] == MaterialKind::Matte;
            let leaves = is_matte && direction.dot(true_normal) > 0.0 && local.z > 0.0;
            let mut throughput = if leaves { paths.throughput(row) } else { [0.0; 3] };
            if FROM_LIGHT && shading.is_some() {
                let falls = falls_by_shading(true_normal, by_shading, -rays.direction_of(row));
                throughput = throughput.map(|part| part * falls);
            }
            ScatteredRay {
                origin: offset_origin(surface.position, surface.normal, surface.bound),
                direction,
                throughput: [0, 1, 2].map(|part| throughput[part] * colour[part]),
                pdf: local.z * FRAC_1_PI,
            }
        });
    }
}
// ANCHOR_END: sample_matte

/// The stage for paths from the camera.
pub fn matte_stage() -> Stage {
    reading(Stage::new("Sample BSDFs: matte", TileSystems::SampleBsdfs, sample_matte::<false>))
        .on_camera_paths()
        .when(scattered_evidence)
}

/// The stage for paths from lights.
pub fn matte_light_stage() -> Stage {
    reading(Stage::new("Sample BSDFs: matte, from lights", TileSystems::SampleBsdfs, sample_matte::<true>))
        .on_light_paths()
        .when(|scene| traced_evidence(scene).and(|| scattered_evidence(scene)))
}

fn reading(stage: Stage) -> Stage {
    stage.kind(StageKind::Estimator).appends::<Scattered>()
}

/// Evidence that light is scattered from matte surfaces to others.
pub(super) fn scattered_evidence(scene: &Census<'_>) -> Evidence {
    needed_if(scene, |integrator| integrator.transport().samples_diffuse)
        .and(|| material_kind_evidence::<Matte>(scene, "matte surface"))
}
