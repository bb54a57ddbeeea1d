use super::previous_surfaces::previous_surface_evidence;
use super::{CausticPaths, PreviousSurfaces};
use crate::each::Each;
use crate::extract::{
    AreaLightTable, EmissiveTable, EnvironmentLightTable, EnvironmentTable, IntegratorTable, bidirectional_evidence,
    caustics_evidence, emissive_evidence, environment_light_evidence, followed_evidence, light_sampling_evidence,
    one_sided_evidence, primitive_evidence,
};
use crate::intersect::{EmissiveRows, HitPrimitives, Hits, NO_SHAPE, SurfaceSides};
use crate::lights::Receiver;
use crate::plan::{Census, Column, Evidence, Shared, Stage, StageKind, TileSystems, VectorRowsMut};
use crate::rays::{Depth, Paths, WorldRays};
use crate::shade::{EmissionFactors, Radiance, area_light_pdf, environment_pdf, environment_radiance};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::DVec3;

// ANCHOR: power_heuristic
/// The MIS weight of a sample taken with pdf `own` that the other strategy would take with pdf `other`: the power
/// heuristic p² / (p² + q²) (Veach and Guibas 1995).
///
/// Only the ratio of the pdfs is squared, so that neither overflows or underflows.
#[inline(always)]
pub fn power_heuristic(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    let ratio = other / own;
    1.0 / (1.0 + ratio * ratio)
}
// ANCHOR_END: power_heuristic

/// Hits on emissive surfaces, the paths that found them, and the radiance that emission is added to.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct MisEmissionView {
    depth: &'static Depth,
    paths: &'static Paths,
    rays: &'static WorldRays,
    caustic: Option<&'static CausticPaths>,
    previous: Option<&'static PreviousSurfaces>,
    hits: &'static Hits,
    primitives: Option<&'static HitPrimitives>,
    list: &'static EmissiveRows,
    sides: Option<&'static SurfaceSides>,
    factors: Option<&'static EmissionFactors>,
    radiance: &'static mut Radiance,
}

// ANCHOR: add_mis_emission
/// Adds the emission of the surface that a ray hit, weighted against light sampling, unless light tracing finds the
/// same path.
///
/// After a specular bounce, or where the surface cannot be sampled as a light, the emission counts in full.
/// Otherwise the previous surface has sampled lights too, so the emission gets its MIS weight, or none where light
/// sampling is used alone.
pub fn add_mis_emission(
    emissive: Res<Shared<EmissiveTable>>,
    lights: Res<Shared<AreaLightTable>>,
    integrator: Res<Shared<IntegratorTable>>,
    mut tiles: Query<MisEmissionView>,
) {
    for view in &mut tiles {
        let MisEmissionViewItem { depth, paths, rays, caustic, previous, hits, primitives, .. } = view;
        let MisEmissionViewItem { list, sides, factors, mut radiance, .. } = view;
        for (&row, &of) in list.row.iter().zip(&list.emissive) {
            let (row, emitted) = (row as usize, emissive.radiance[of as usize]);
            if sides.is_some_and(|sides| sides.outside[row] == 0 && emissive.one_sided[of as usize]) {
                continue;
            }
            let light = lights.light_of_hit(hits.shape[row], || primitives.map_or(0, |own| own.primitive[row]));
            let by_mirror = paths.pdf[row] == f64::INFINITY;
            let from_light = |caustic: &CausticPaths| {
                by_mirror && depth.0 > 0 && light.is_some() && caustic.spread[paths.first[row] as usize] != 0
            };
            let weight = if caustic.is_some_and(from_light) {
                0.0
            } else if let Some(light) = light.filter(|_| !by_mirror && integrator.samples_lights) {
                if integrator.mis {
                    let normal = previous.map_or(DVec3::ZERO, |previous| previous.normal(row).as_dvec3());
                    let receiver = Receiver { position: rays.origin_of(row), normal, depth: depth.0.saturating_sub(1) };
                    let at = rays.point_at(row, hits.t[row]);
                    power_heuristic(paths.pdf[row], area_light_pdf(&lights, light, &receiver, at))
                } else {
                    0.0
                }
            } else {
                1.0
            } as f32;
            let emitted = factors.map_or(emitted, |factors| factors.times(row, emitted));
            radiance.rgb.add(row, emitted.each(|part| weight * part));
        }
    }
}
// ANCHOR_END: add_mis_emission

/// The stage that runs [`add_mis_emission`], the alternative to adding emission in full.
pub fn mis_emission_stage() -> Stage {
    at_emitters(Stage::new("Add emission, weighted by MIS", TileSystems::Shade, add_mis_emission))
        .reads_where::<CausticPaths>(caustics_evidence)
        .when(mis_emission_evidence)
}

/// A stage that weights the emission which camera paths find, with what it may have to know of the lamp.
pub(super) fn at_emitters(stage: Stage) -> Stage {
    stage
        .on_camera_paths()
        .kind(StageKind::Alternative)
        .reads_where::<SurfaceSides>(one_sided_evidence)
        .reads_where::<HitPrimitives>(primitive_evidence)
        .reads_where::<PreviousSurfaces>(previous_surface_evidence)
}

/// Evidence that some emitting surfaces are sampled as lights, so that their emission must not be counted twice.
pub(super) fn mis_emission_evidence(scene: &Census<'_>) -> Evidence {
    let emits = emissive_evidence(scene).and(|| followed_evidence(scene));
    let joined = bidirectional_evidence(scene);
    if joined.needed {
        return Evidence { needed: false, ..joined };
    }
    let traced = emits.clone().and(|| caustics_evidence(scene));
    if traced.needed { traced } else { emits.and(|| light_sampling_evidence(scene)) }
}

/// Adds the environment's radiance to the rays that hit nothing, weighted against light sampling.
pub fn add_mis_environment(
    environment: Res<Shared<EnvironmentTable>>,
    light: Res<Shared<EnvironmentLightTable>>,
    integrator: Res<Shared<IntegratorTable>>,
    mut tiles: Query<(&Paths, &WorldRays, Option<&Hits>, &mut Radiance)>,
) {
    for (paths, rays, hits, mut radiance) in &mut tiles {
        for row in (0..rays.rows()).filter(|&row| hits.is_none_or(|hits| hits.shape[row] == NO_SHAPE)) {
            let direction = rays.direction_of(row);
            let weight = if paths.pdf[row] == f64::INFINITY {
                1.0
            } else if integrator.mis {
                power_heuristic(paths.pdf[row], environment_pdf(&light, environment.turn, direction))
            } else {
                0.0
            };
            let found = environment_radiance(&environment, direction);
            radiance.rgb.add(row, found.each(|part| (weight * part) as f32));
        }
    }
}

/// The stage that runs [`add_mis_environment`], the alternative to adding the environment in full.
pub fn mis_environment_stage() -> Stage {
    Stage::new("Add the environment, weighted by MIS", TileSystems::Background, add_mis_environment)
        .kind(StageKind::Alternative)
        .when(|scene| {
            environment_light_evidence(scene).and(|| followed_evidence(scene)).and(|| light_sampling_evidence(scene))
        })
}
