//! Stages with one mistake each, to take the place of pinhole's or to spoil what they wrote: for figures, and for tests
//! that must notice.

use super::emitter::{pdf_without_cosine, pdf_without_jacobian};
use super::path::uniform_direction;
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::extract::{
    AreaLightTable, GlassTable, IntegratorTable, LensTable, MaterialKind, MaterialTable, NO_ROW, SamplingTable,
    ShutterTable, bsdf_evidence, glass_evidence, material_evidence, mis_evidence, occlusion_evidence,
};
use pinhole::follow::{Scattered, ScatteredRay, SkyLists, SkyView, sample_sky_with};
use pinhole::intersect::{MaterialRows, SurfaceSides, Surfaces};
use pinhole::material::{MetalTable, cosine_pdf, frame_of};
use pinhole::plan::{Column, Shared, Stage, StageKind, TileSystems, VectorRows, VectorRowsMut};
use pinhole::rays::{
    Depth, Draws, LensPoints, Paths, PixelSamples, RasterPoints, RayTimes, SampleNumber, Tile, draws_of_two,
};
use pinhole::sample::{Purpose, uniform};
use pinhole::shade::{ShadowRays, area_light_stage};
use pinhole::shapes::emitter::parallelogram_area_pdf;
use pinhole::shapes::{Emitter, distance_to, offset_origin};
use std::f64::consts::FRAC_1_PI;

/// How a matte surface sends light on: a direction about +z by two numbers, and the weight that it counts with, by albedo and
/// cosine.
#[derive(Clone, Copy)]
pub struct MatteSample {
    /// The direction.
    pub direction: fn([f64; 2]) -> DVec3,
    /// The weight: BSDF times cosine over pdf.
    pub weight: fn(f64, f64) -> f64,
}

/// Matte surfaces alone continue paths, by this sample; in place of all stages that sample BSDFs.
pub fn scatter_matte_by(sample: MatteSample) -> Stage {
    type Known<'a> = (&'a Tile, &'a Depth, Option<&'a SampleNumber>, Option<&'a PixelSamples>, &'a Paths);
    let scatter =
        move |sampling: Res<Shared<SamplingTable>>,
              materials: Res<Shared<MaterialTable>>,
              mut points: Local<Vec<[f64; 2]>>,
              mut tiles: Query<(Known<'static>, &Surfaces, &MaterialRows, &mut Scattered)>| {
            for ((tile, &depth, number, samples, paths), surfaces, list, mut scattered) in &mut tiles {
                let draws = Draws { sampling: &sampling, tile, number, samples, paths: Some(paths), depth };
                draws_of_two(&draws, Purpose::Direction, &list.row, &mut points);
                scattered.append(&list.row, |number, row| {
                    let surface = surfaces.get(row);
                    let local = (sample.direction)(points[number]);
                    let (throughput, colour) =
                        (paths.throughput(row), materials.parameters[surface.material as usize].colour);
                    ScatteredRay {
                        origin: offset_origin(surface.position, surface.normal, surface.bound),
                        direction: frame_of(surface.normal.as_dvec3()) * local,
                        throughput: [0, 1, 2].map(|part| throughput[part] * (sample.weight)(colour[part], local.z)),
                        pdf: cosine_pdf(local.z),
                    }
                });
            }
        };
    Stage::new("Scatter with a mistake", TileSystems::SampleBsdfs, scatter)
        .kind(StageKind::Estimator)
        .appends::<Scattered>()
        .when(material_evidence)
}

/// A stage that spoils what was scattered, after all that scatter.
fn spoils(stage: Stage) -> Stage {
    stage.kind(StageKind::Alternative)
}

fn spoil_ray(scattered: &mut Scattered, ray: usize, factor: f64) {
    scattered.throughput.scale(ray, [factor; 3]);
}

/// The wrong pdf: rays off rough metal are sampled by its microfacets, and divided by the cosine-weighted pdf.
pub fn metal_counted_as_matte() -> Stage {
    let spoil = |materials: Res<Shared<MaterialTable>>, mut tiles: Query<(&Surfaces, &mut Scattered)>| {
        for (surfaces, mut scattered) in &mut tiles {
            for ray in 0..scattered.rows() {
                let surface = surfaces.get(scattered.row[ray] as usize);
                let pdf = scattered.pdf[ray];
                if materials.kind[surface.material as usize] == MaterialKind::Metal && pdf.is_finite() {
                    let cosine = scattered.direction_of(ray).dot(surface.normal.as_dvec3()).max(1e-6);
                    spoil_ray(&mut scattered, ray, pdf / (cosine * FRAC_1_PI));
                }
            }
        }
    };
    spoils(Stage::new("Forget how metal was sampled", TileSystems::Roulette, spoil)).when(bsdf_evidence::<MetalTable>)
}

/// A beam that enters glass becomes narrower, and its radiance is divided by η² on the path back to the camera; here it is not
/// multiplied again where it leaves.
pub fn glass_that_keeps_beams_narrow() -> Stage {
    let spoil = |(materials, glass): (Res<Shared<MaterialTable>>, Res<Shared<GlassTable>>),
                 mut tiles: Query<(&Surfaces, &SurfaceSides, &mut Scattered)>| {
        for (surfaces, sides, mut scattered) in &mut tiles {
            for ray in 0..scattered.rows() {
                let row = scattered.row[ray] as usize;
                let surface = surfaces.get(row);
                let interior = materials.interior[surface.material as usize];
                let through = scattered.direction_of(ray).dot(surface.normal.as_dvec3()) < 0.0;
                if through && interior != NO_ROW && sides.outside[row] == 0 {
                    let ior = glass.ior[interior as usize];
                    spoil_ray(&mut scattered, ray, 1.0 / (ior * ior));
                }
            }
        }
    };
    spoils(Stage::new("Forget where rays leave glass", TileSystems::Roulette, spoil)).when(glass_evidence)
}

/// The missing cosine: rays to the sky are sampled uniformly, and each counts the same; in place of all stages that sample lights.
pub fn sky_in_all_directions_alike() -> Stage {
    let aim = |sampling: Res<Shared<SamplingTable>>,
               integrator: Res<Shared<IntegratorTable>>,
               lists: Local<SkyLists>,
               tiles: Query<SkyView>| {
        sample_sky_with(|numbers| DVec3::from(uniform_direction(numbers)), (&sampling, &integrator), lists, tiles);
    };
    Stage::new("Sample the open sky uniformly", TileSystems::SampleLights, aim)
        .kind(StageKind::Alternative)
        .appends::<ShadowRays>()
        .when(occlusion_evidence)
}

/// Light samples count in full, though BSDF sampling finds the same light; in place of all stages that compute MIS weights.
pub fn light_samples_counted_in_full() -> Stage {
    Stage::new("Count light samples in full", TileSystems::MisWeights, |_: Query<&mut ShadowRays>| ())
        .kind(StageKind::Alternative)
        .when(mis_evidence)
}

/// How far a ray's end may lie from a light's plane, as a fraction of its length, and count as on it.
const ON_LIGHT: f64 = 1e-5;

/// The light's own cosine forgotten in the pdf of its area.
pub fn light_without_cosine() -> Stage {
    spoils_light_sampling("Forget the light's cosine", |lights, mut tiles| {
        tiles.iter_mut().for_each(|mut rays| reweigh(&lights, &mut rays, pdf_without_cosine));
    })
}

/// The Jacobian forgotten: the pdf per area taken for one per solid angle.
pub fn light_without_jacobian() -> Stage {
    spoils_light_sampling("Forget the Jacobian", |lights, mut tiles| {
        tiles.iter_mut().for_each(|mut rays| reweigh(&lights, &mut rays, |_, area| pdf_without_jacobian(area)));
    })
}

/// After the rays to lights, before what blocks them.
fn spoils_light_sampling(name: &'static str, forget: fn(Res<Shared<AreaLightTable>>, Query<&mut ShadowRays>)) -> Stage {
    Stage::new(name, TileSystems::SampleLights, forget)
        .kind(StageKind::Alternative)
        .appends::<ShadowRays>()
        .when(|scene| (area_light_stage().when)(scene))
}

/// Multiplies what each ray to a rectangle brings by the right pdf of a point of its area over another: on average
/// that is what points of the area would bring, weighted by that other.
fn reweigh(lights: &AreaLightTable, rays: &mut ShadowRays, naive: impl Fn(DVec3, f64) -> f64) {
    for ray in 0..rays.rows() {
        let from = rays.origin_of(ray);
        let (direction, distance) = (rays.direction_of(ray), f64::from(rays.t_max[ray]));
        let ends_on = |light: &&Emitter| (distance_to(light, from, direction) / distance - 1.0).abs() < ON_LIGHT;
        let Some(Emitter::Rectangle(planar)) = lights.emitter.iter().find(ends_on) else { continue };
        let to = direction * distance;
        let factor = (parallelogram_area_pdf(planar, to) / naive(to, planar.area())) as f32;
        rays.irradiance.scale(ray, [factor; 3]);
    }
}

/// The stage that samples points on the lens, with another mapping to its disk.
pub fn opening_filled_by(point: fn(DVec2) -> DVec2) -> Stage {
    let fill = move |lens: Res<Shared<LensTable>>, mut tiles: Query<(&RasterPoints, &mut LensPoints)>| {
        for (raster, mut points) in &mut tiles {
            let mut in_lens = points.slices_mut(raster.rows());
            for row in 0..raster.rows() {
                // Where in its pixel a sample is decides; enough for a picture.
                let key = raster.point.at(row).map(|along| along.to_bits() as u32);
                let u = DVec2::new(uniform(1, key, 0, Purpose::Lens), uniform(2, key, 0, Purpose::Lens));
                in_lens.put(row, point(u) * lens.radius);
            }
        }
    };
    Stage::new("Sample the lens otherwise", TileSystems::Lens, fill).kind(StageKind::Alternative)
}

/// The stage that draws times, by so many moments in turn.
pub fn moments_in_turn(frames: u32) -> Stage {
    let fill = move |shutter: Res<Shared<ShutterTable>>, mut tiles: Query<(&PixelSamples, &mut RayTimes)>| {
        for (samples, mut times) in &mut tiles {
            times.time.clear();
            times.time.extend(samples.sample.iter().map(|&sample| time_of_frame(sample, frames, shutter.length)));
        }
    };
    Stage::new("Take moments in turn", TileSystems::Lens, fill).kind(StageKind::Alternative)
}

// ANCHOR: time_of_frame
/// The time of a sample where all pixels take the same few moments, in turn.
///
/// What moves farther than its own width between two of them shows as so many ghosts, at any number of samples.
#[must_use]
pub fn time_of_frame(sample: u32, frames: u32, length: f64) -> f64 {
    (f64::from(sample % frames) + 0.5) / f64::from(frames) * length
}
// ANCHOR_END: time_of_frame
