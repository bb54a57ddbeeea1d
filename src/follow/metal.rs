use super::{MetalRows, Scattered, ScatteredRay, frame_of, ggx_brdf, ggx_sample};
use crate::extract::{MaterialKind, MaterialTable, MetalTable, SamplingTable, metal_evidence, needed_if};
use crate::intersect::{NO_SHAPE, ShadingNormals, Surfaces, offset_origin};
use crate::plan::{Column, Evidence, Shared, Stage, StageKind, TileSystems};
use crate::rays::{Draws, Paths, draws_of_two};
use crate::rays::{Leg, PixelSamples, SampleNumber, Tile, WorldRays};
use crate::sample::Purpose;
use crate::scene::Integrator;
use crate::shade::{LightRays, Radiance, ShadowHits, lit_evidence};
use bevy_ecs::prelude::*;

/// Sends a ray on from rough metal, by a tiny mirror at random among those seen.
pub fn scatter_metal(
    sampling: Res<Shared<SamplingTable>>,
    metals: Res<Shared<MetalTable>>,
    mut points: Local<Vec<[f64; 2]>>,
    mut tiles: Query<(
        (&Tile, &Leg, Option<&SampleNumber>, Option<&PixelSamples>, &WorldRays, &Paths),
        (&Surfaces, Option<&ShadingNormals>, &MetalRows),
        &mut Scattered,
    )>,
) {
    for ((tile, &leg, number, samples, rays, paths), (surfaces, shading, list), mut scattered) in &mut tiles {
        let draws = Draws { sampling: &sampling, tile, number, samples, paths: Some(paths), leg };
        draws_of_two(&draws, Purpose::Direction, &list.row, &mut points);
        scattered.append(&list.row, |number, row| {
            let (surface, metal) = (surfaces.get(row), list.of[number] as usize);
            let own = surface.normal.as_dvec3();
            let world_from_local = frame_of(shading.map_or(own, |normals| normals.get(row)));
            let to_eye = world_from_local.transpose() * -rays.direction_of(row);
            let Some(glint) = ggx_sample(to_eye, metals.alpha[metal], points[number]) else {
                return ScatteredRay::default();
            };
            let direction = world_from_local * glint.to_light;
            let weight = if direction.dot(own) > 0.0 { glint.weight } else { 0.0 };
            let (share, colour) = (paths.share(row), metals.colour[metal]);
            ScatteredRay {
                origin: offset_origin(surface.position, surface.normal, surface.bound),
                direction,
                share: [0, 1, 2].map(|part| share[part] * colour[part] * weight),
                density: glint.density,
            }
        });
    }
}

/// Adds what rough metal sends towards the eye of each light ray's irradiance, unless something stands in between.
pub fn add_metal(
    materials: Res<Shared<MaterialTable>>,
    metals: Res<Shared<MetalTable>>,
    mut tiles: Query<(
        (&WorldRays, &Surfaces, Option<&ShadingNormals>),
        (&LightRays, Option<&ShadowHits>, &mut Radiance),
    )>,
) {
    for ((eye, surfaces, shading), (light, hits, mut radiance)) in &mut tiles {
        for ray in 0..light.rows() {
            let row = light.path[ray] as usize;
            let surface = surfaces.get(row);
            let material = surface.material as usize;
            if materials.kind[material] != MaterialKind::Metal || hits.is_some_and(|hits| hits.shape[ray] != NO_SHAPE) {
                continue;
            }
            let metal = materials.row[material] as usize;
            let normal = shading.map_or_else(|| surface.normal.as_dvec3(), |normals| normals.get(row));
            let local_from_world = frame_of(normal).transpose();
            let [to_light, to_eye] =
                [light.direction_of(ray), -eye.direction_of(row)].map(|way| local_from_world * way);
            let brdf = ggx_brdf(to_light, to_eye, metals.alpha[metal]);
            let (irradiance, colour) = (light.irradiance(ray), metals.colour[metal]);
            let [r, g, b] =
                [0, 1, 2].map(|part| (brdf * colour[part] * irradiance[part]).min(f64::from(f32::MAX)) as f32);
            radiance.r[row] += r;
            radiance.g[row] += g;
            radiance.b[row] += b;
        }
    }
}

/// The stage that sends rays on.
pub fn metal_stage() -> Stage {
    Stage::new("Scatter off rough metal", TileSystems::Scatter, scatter_metal)
        .kind(StageKind::Estimator)
        .reads::<WorldRays>()
        .reads::<Paths>()
        .reads_if::<PixelSamples>()
        .reads::<Surfaces>()
        .reads_if::<ShadingNormals>()
        .reads::<MetalRows>()
        .appends::<Scattered>()
        .table::<SamplingTable>()
        .table::<MetalTable>()
        .when(|scene| metal_evidence(scene).and(|| scattered_evidence(scene)))
}

/// The stage that answers lamps.
pub fn metal_light_stage() -> Stage {
    Stage::new("Add the light off rough metal", TileSystems::Shade, add_metal)
        .reads::<WorldRays>()
        .reads::<Surfaces>()
        .reads_if::<ShadingNormals>()
        .reads::<LightRays>()
        .reads_if::<ShadowHits>()
        .reads::<Radiance>()
        .writes::<Radiance>()
        .table::<MaterialTable>()
        .table::<MetalTable>()
        .when(|scene| metal_evidence(scene).and(|| lit_evidence(scene)))
}

/// Evidence that directions off rough metal are drawn.
fn scattered_evidence(scene: &World) -> Evidence {
    needed_if(scene, |integrator| matches!(integrator, Integrator::Path { .. } | Integrator::Distribution { .. }))
}
