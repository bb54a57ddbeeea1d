use super::light::{ShadowRay, cosine_of};
use super::receivers::{LightRay, LightRows, append_sampled};
use super::view::{LightSamplingView, LightSamplingViewItem};
use super::{ShadowRays, environment_radiance, equirectangular, irradiance_from_area};
use crate::extract::{
    EnvironmentLightTable, EnvironmentTable, SamplingTable, environment_light_evidence, light_sampling_evidence,
    material_evidence,
};
use crate::intersect::Surface;
use crate::plan::{Shared, Stage, StageKind, TileSystems};
use crate::rays::{DrawsView, Paths};
use crate::sample::{Draw, Purpose, with_sampler};
use crate::shapes::offset_origin;
use bevy_ecs::prelude::*;
use glam::DVec3;
use std::f64::consts::TAU;

// ANCHOR: environment_direction
/// A direction sampled in proportion to the environment's light, and its pdf, in 1/sr.
///
/// A texel is chosen by its light; within it, longitude and the cosine of the polar angle are uniform, which is uniform
/// in solid angle.
#[inline(always)]
pub fn environment_direction(light: &EnvironmentLightTable, turn: [f64; 2], u: [f64; 2]) -> (DVec3, f64) {
    let ([row, column], [down, across]) = light.chosen(u);
    let versine = light.versine[row] + down * (light.versine[row + 1] - light.versine[row]);
    let longitude = ((column as f64 + 0.5 + across) / light.columns as f64 - 0.5) * TAU;
    let level = (versine * (2.0 - versine)).max(0.0).sqrt();
    let there = DVec3::new(level * libm::sin(longitude), 1.0 - versine, -level * libm::cos(longitude));
    let [sine, cosine] = turn;
    let direction = DVec3::new(there.x * cosine + there.z * sine, there.y, there.z * cosine - there.x * sine);
    (direction, light.pdf([row, column]))
}
// ANCHOR_END: environment_direction

/// The pdf with which [`environment_direction`] samples a direction, in 1/sr.
#[inline(always)]
pub fn environment_pdf(light: &EnvironmentLightTable, turn: [f64; 2], direction: DVec3) -> f64 {
    let [sine, cosine] = turn;
    let DVec3 { x, y, z } = direction;
    let at = equirectangular(DVec3::new(x * cosine - z * sine, y, x * sine + z * cosine));
    let (width, height) = (light.columns as f64, (light.rows - 1) as f64);
    let column = (at.x * width - 0.5).rem_euclid(width) as usize % light.columns;
    let row = ((at.y * height + 0.5) as usize).min(light.rows - 1);
    light.pdf([row, column])
}

/// A 32-bit fraction as a number with all of its bits, since a bright texel may be very narrow.
#[inline(always)]
fn whole_unit(bits: u32) -> f64 {
    f64::from(bits) * (1.0 / 4_294_967_296.0)
}

/// Samples the environment for one surface: a shadow ray without end, and its pdf.
#[inline(always)]
fn sample_environment_at(
    environment: &EnvironmentTable,
    light: &EnvironmentLightTable,
    surface: &Surface,
    normal: DVec3,
    u: [f64; 2],
) -> (LightRay, f64) {
    let (direction, pdf) = environment_direction(light, environment.turn, u);
    let origin = offset_origin(surface.position, surface.normal, surface.bound);
    let radiance = environment_radiance(environment, direction);
    let direction = direction.as_vec3();
    let cosine = if pdf > 0.0 { cosine_of(surface, normal, direction) } else { 0.0 };
    let irradiance = irradiance_from_area(radiance, cosine, pdf);
    let ray = ShadowRay { origin, direction, distance: f64::INFINITY, cosine };
    (LightRay { ray, t_max: f32::INFINITY, irradiance }, pdf)
}

/// Appends, for each row, a shadow ray to a bright part of the environment.
pub fn sample_environment(
    environment: Res<Shared<EnvironmentTable>>,
    light: Res<Shared<EnvironmentLightTable>>,
    sampling: Res<Shared<SamplingTable>>,
    mut tiles: Query<(LightSamplingView, DrawsView, Option<&Paths>)>,
) {
    for (LightSamplingViewItem { surfaces, shading, list, far, mut rays, mut pdfs }, draws, paths) in &mut tiles {
        let receivers = LightRows::new(surfaces, shading, list, far);
        let (draws, to) = (draws.draws(&sampling, paths), (&mut *rays, pdfs.as_deref_mut()));
        with_sampler!(sampling.sampler, D => {
            let drawn = D::of(draws.sample(), Purpose::EnvironmentPoint);
            append_sampled(&receivers, to, |row, surface, normal| {
                let u = drawn.two(draws.key(row)).map(whole_unit);
                sample_environment_at(&environment, &light, surface, normal, u)
            });
        });
    }
}

/// The stage that runs [`sample_environment`]: light sampling, the alternative to BSDF sampling alone.
pub fn environment_light_stage() -> Stage {
    Stage::new("Sample the environment", TileSystems::SampleLights, sample_environment)
        .kind(StageKind::Alternative)
        .appends::<ShadowRays>()
        .when(|scene| {
            environment_light_evidence(scene).and(|| light_sampling_evidence(scene)).and(|| material_evidence(scene))
        })
}
