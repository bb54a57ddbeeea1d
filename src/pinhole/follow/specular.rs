//! The stages of specular BSDFs, each generic over the BSDF.

use super::bsdf::{BsdfRows, BsdfView, BsdfViewItem, at_interfaces, shading_context, transport};
use super::interface::{Interface, InterfaceView};
use super::{Scattered, ScatteredRay};
use crate::each::Each;
use crate::extract::{
    GlassTable, MaterialTable, SamplingTable, bsdf_evidence, followed_evidence, needed_if, traced_evidence,
};
use crate::intersect::{ShadingNormals, Surface};
use crate::material::{Bsdf, ShadingContext, SpecularSample, mirror_direction};
use crate::plan::{Census, Evidence, Shared, Stage, StageKind, TileSystems};
use crate::rays::{DrawsView, Paths, draws_of_one};
use crate::sample::Purpose;
use crate::shapes::offset_origin;
use bevy_ecs::prelude::*;
use glam::DVec3;
use multiversion::multiversion;

/// The normal to reflect by: the shading normal, or the geometric one where reflection by the former would lead into
/// the surface.
#[inline(always)]
pub(super) fn mirroring_normal(shading: Option<&ShadingNormals>, row: usize, own: DVec3, direction: DVec3) -> DVec3 {
    let normal = shading.map_or(own, |normals| normals.get(row));
    if mirror_direction(direction, normal).dot(own) > 0.0 { normal } else { own }
}

/// The scattered ray of a sample; of throughput 0 where a shading normal sends it to the wrong side.
#[inline(always)]
fn ray(paths: &Paths, row: usize, surface: &Surface, sample: SpecularSample) -> ScatteredRay {
    let side = if sample.through { -surface.normal } else { surface.normal };
    let leaves = sample.direction.dot(side.as_dvec3()) > 0.0;
    let throughput = if leaves { paths.throughput(row) } else { [0.0; 3] };
    ScatteredRay {
        origin: offset_origin(surface.position, side, surface.bound),
        direction: sample.direction,
        throughput: [0, 1, 2].each(|part| throughput[part] * sample.weight[part]),
        pdf: f64::INFINITY,
    }
}

/// The reflectance of layers at a surface, where this BSDF is of what they are made of.
#[inline(always)]
fn layers<B: Bsdf>(interface: &Interface<'_>, row: usize, cosine: f64) -> Option<f64> {
    if B::TRANSMITS { interface.reflectance(row, cosine) } else { None }
}

// ANCHOR: sample_specular
/// Reflects or refracts a ray at every surface with this BSDF.
pub fn sample_specular<B: Bsdf, const FROM_LIGHT: bool>(
    sampling: Res<Shared<SamplingTable>>,
    (materials, bsdf, glass): (Res<Shared<MaterialTable>>, Res<Shared<B>>, Option<Res<Shared<GlassTable>>>),
    mut numbers: Local<Vec<f64>>,
    mut tiles: Query<(BsdfView, DrawsView, InterfaceView, &BsdfRows<B>)>,
) {
    for (BsdfViewItem { rays, paths, surfaces, shading, mut scattered }, draws, interface, list) in &mut tiles {
        let interface = Interface::new(interface, glass.as_deref());
        if bsdf.chooses() {
            draws_of_one(&draws.draws(&sampling, Some(paths)), Purpose::MaterialChoice, &list.row, &mut numbers);
        }
        scattered.append(&list.row, |number, row| {
            let (surface, direction) = (surfaces.get(row), rays.direction_of(row));
            let normal = mirroring_normal(shading, row, surface.normal.as_dvec3(), direction);
            let material = surface.material as usize;
            let of_row = (materials.parameters[material], row, material);
            let reflectance = layers::<B>(&interface, row, -direction.dot(normal));
            let context = ShadingContext {
                reflectance,
                ..shading_context::<B>(&materials, &interface, of_row, transport(FROM_LIGHT))
            };
            let number = numbers.get(number).copied().unwrap_or_default();
            ray(paths, row, &surface, bsdf.sample_specular(&context, direction, normal, number))
        });
    }
}
// ANCHOR_END: sample_specular

/// The least throughput of a ray that is traced where both are: their number doubles at every surface, and most
/// contribute next to nothing.
const MIN_THROUGHPUT: f64 = 1.0 / 512.0;

// ANCHOR: split_rays
/// Traces both rays at every surface with this BSDF (Whitted 1980), except for those with too little throughput to be
/// seen.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn split_rays<B: Bsdf>(
    (materials, bsdf, glass): (Res<Shared<MaterialTable>>, Res<Shared<B>>, Option<Res<Shared<GlassTable>>>),
    mut tiles: Query<(BsdfView, InterfaceView, &BsdfRows<B>)>,
) {
    for (BsdfViewItem { rays, paths, surfaces, shading, mut scattered }, interface, list) in &mut tiles {
        let interface = Interface::new(interface, glass.as_deref());
        for which in [0, 1] {
            scattered.append(&list.row, |_, row| {
                let (surface, direction) = (surfaces.get(row), rays.direction_of(row));
                let normal = mirroring_normal(shading, row, surface.normal.as_dvec3(), direction);
                let material = surface.material as usize;
                let of_row = (materials.parameters[material], row, material);
                let reflectance = layers::<B>(&interface, row, -direction.dot(normal));
                let context = ShadingContext {
                    reflectance,
                    ..shading_context::<B>(&materials, &interface, of_row, transport(false))
                };
                let ray = ray(paths, row, &surface, bsdf.specular_directions(&context, direction, normal)[which]);
                let seen = ray.throughput.iter().any(|part| *part >= MIN_THROUGHPUT);
                if seen { ray } else { ScatteredRay::default() }
            });
        }
    }
}
// ANCHOR_END: split_rays

/// The stage that traces both rays.
pub fn split_stage<B: Bsdf>() -> Stage {
    reading::<B>(Stage::new(B::NAMES.split, TileSystems::SampleBsdfs, split_rays::<B>))
        .on_camera_paths()
        .when(|scene| bsdf_evidence::<B>(scene).and(|| split_evidence(scene)))
}

/// The stage that traces one ray: of a BSDF that transmits light, the one selected at random.
pub fn specular_stage<B: Bsdf>() -> Stage {
    let stage = reading::<B>(Stage::new(B::NAMES.sample, TileSystems::SampleBsdfs, sample_specular::<B, false>));
    if !B::TRANSMITS {
        return stage.when(|scene| bsdf_evidence::<B>(scene).and(|| followed_evidence(scene)));
    }
    stage.on_camera_paths().when(|scene| {
        let both = split_evidence(scene);
        let one = Evidence { needed: !both.needed, ..both };
        bsdf_evidence::<B>(scene).and(|| followed_evidence(scene)).and(|| one)
    })
}

/// The stage that traces one ray for paths from lights.
pub fn specular_from_lights_stage<B: Bsdf>() -> Stage {
    let stage = Stage::new(B::NAMES.sample_from_lights, TileSystems::SampleBsdfs, sample_specular::<B, true>);
    reading::<B>(stage).on_light_paths().when(|scene| traced_evidence(scene).and(|| bsdf_evidence::<B>(scene)))
}

fn reading<B: Bsdf>(stage: Stage) -> Stage {
    let kind = if B::TRANSMITS { StageKind::Alternative } else { StageKind::Exact };
    at_interfaces::<B>(stage).kind(kind).appends::<Scattered>()
}

/// Evidence that both rays are traced at glass.
fn split_evidence(scene: &Census<'_>) -> Evidence {
    needed_if(scene, |integrator| integrator.transport().splits_at_glass)
}
