use super::frame::{cosine_direction, frame_of};
use super::{Scattered, ScatteredRay};
use crate::extract::{MaterialTable, SamplingTable, material_evidence, needed_if};
use crate::intersect::{MaterialRows, ShadingNormals, Surfaces, offset_origin};
use crate::plan::{Evidence, Shared, Stage, StageKind, TileSystems};
use crate::rays::{Draws, Leg, Paths, PixelSamples, SampleNumber, Tile, draws_of_two};
use crate::sample::Purpose;
use crate::scene::Integrator;
use crate::shade::SurfaceColours;
use bevy_ecs::prelude::*;
use std::f64::consts::FRAC_1_PI;

// ANCHOR: scatter_matte
/// Sends a ray on from every matte surface, as densely as the cosine to its normal.
///
/// The surface sends on colour / π of what comes from there, times that cosine; divided by the density, cosine / π, the
/// colour is left.
pub fn scatter_matte(
    sampling: Res<Shared<SamplingTable>>,
    materials: Res<Shared<MaterialTable>>,
    mut points: Local<Vec<[f64; 2]>>,
    mut tiles: Query<(
        (&Tile, &Leg, Option<&SampleNumber>, Option<&PixelSamples>, &Paths),
        (&Surfaces, Option<&ShadingNormals>, Option<&SurfaceColours>, &MaterialRows),
        &mut Scattered,
    )>,
) {
    for ((tile, &leg, number, samples, paths), (surfaces, shading, colours, list), mut scattered) in &mut tiles {
        let draws = Draws { sampling: &sampling, tile, number, samples, paths: Some(paths), leg };
        draws_of_two(&draws, Purpose::Direction, &list.row, &mut points);
        scattered.append(&list.row, |number, row| {
            let surface = surfaces.get(row);
            let true_normal = surface.normal.as_dvec3();
            let normal = shading.map_or(true_normal, |normals| normals.get(row));
            let local = cosine_direction(points[number]);
            let direction = frame_of(normal) * local;
            let material = surface.material as usize;
            let colour = colours.map_or_else(|| materials.colour[material], |colours| colours.get(row));
            let leaves = direction.dot(true_normal) > 0.0 && local.z > 0.0;
            let share = if leaves { paths.share(row) } else { [0.0; 3] };
            ScatteredRay {
                origin: offset_origin(surface.position, surface.normal, surface.bound),
                direction,
                share: [0, 1, 2].map(|part| share[part] * colour[part]),
                density: local.z * FRAC_1_PI,
            }
        });
    }
}
// ANCHOR_END: scatter_matte

/// The stage on offer.
pub fn matte_stage() -> Stage {
    Stage::new("Scatter off matte surfaces", TileSystems::Scatter, scatter_matte)
        .kind(StageKind::Estimator)
        .reads::<Paths>()
        .reads_if::<PixelSamples>()
        .reads::<Surfaces>()
        .reads_if::<ShadingNormals>()
        .reads_if::<SurfaceColours>()
        .reads::<MaterialRows>()
        .appends::<Scattered>()
        .table::<SamplingTable>()
        .table::<MaterialTable>()
        .when(scattered_evidence)
}

/// Evidence that matte surfaces light each other.
pub(super) fn scattered_evidence(scene: &World) -> Evidence {
    needed_if(scene, |integrator| matches!(integrator, Integrator::Path { .. })).and(|| material_evidence(scene))
}
