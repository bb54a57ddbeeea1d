use super::ShadowRays;
use super::light::{ShadowRay, cosine_of, shadow_t_max};
use super::radiance::{LightSamplingView, LightSamplingViewItem};
use super::receivers::{LightRay, LightRows, RayLists, append_sampled};
use crate::extract::{AreaLightTable, SamplingTable, area_light_evidence, light_sampling_evidence, material_evidence};
use crate::intersect::Surface;
use crate::lights::Receiver;
use crate::plan::{Shared, Stage, StageKind, TileSystems};
use crate::rays::{DrawsView, Paths};
use crate::sample::{Draw, PixelKey, Purpose, unit, with_sampler};
use crate::shapes::{distance_to, offset_origin, pdf_towards, point_on};
use bevy_ecs::prelude::*;
use glam::DVec3;

// ANCHOR: irradiance_from_area
/// One sample's estimate of the irradiance from an area light of radiance L: L cos θ / p.
///
/// p is the pdf of the sampled direction per unit of solid angle, so the mean of many samples converges to the integral
/// of L cos θ over the directions that the light subtends.
#[inline(always)]
pub fn irradiance_from_area(radiance: [f64; 3], cosine: f64, pdf: f64) -> [f64; 3] {
    let weight = cosine / pdf;
    [radiance[0] * weight, radiance[1] * weight, radiance[2] * weight]
}
// ANCHOR_END: irradiance_from_area

/// The pdf of sampling a point on a light from another point, in 1/sr, including the probability of choosing that
/// light; 0 where the light does not shine.
///
/// `receiver` is where a ray starts that hit the light at `at`; its normal counts where there are many lights.
#[inline(always)]
pub fn area_light_pdf(lights: &AreaLightTable, light: usize, receiver: &Receiver, at: DVec3) -> f64 {
    let from = receiver.position;
    lights.with_light(light, |emitter, _, one_sided| {
        let shines = !one_sided || emitter.faces(from);
        if shines { lights.probability_of(light, receiver) * pdf_towards(emitter, from, at) } else { 0.0 }
    })
}

// ANCHOR: sample_light
/// Chooses a light and samples a point on it; returns the shadow ray towards it and its pdf in 1/sr.
///
/// The shadow ray follows its direction as rounded to f32, so its end is computed anew by intersecting the light along
/// it: otherwise a light hit at grazing incidence would block its own ray.
#[inline(always)]
fn sample_light(
    lights: &AreaLightTable,
    choice: u32,
    surface: &Surface,
    normal: DVec3,
    u: [f64; 2],
) -> (LightRay, f64) {
    let origin = offset_origin(surface.position, surface.normal, surface.bound);
    let from = origin.as_dvec3();
    let receiver = Receiver { position: from, normal: surface.normal.as_dvec3() };
    let (light, probability) = lights.choose(&receiver, choice);
    lights.with_light(light, |emitter, radiance, one_sided| {
        let point = point_on(emitter, from, u);
        let pdf = probability * point.pdf;
        let shines = pdf > 0.0 && (!one_sided || emitter.faces(from));

        let length = point.to.length();
        let direction = (point.to * (1.0 / length)).as_vec3();
        let hit = distance_to(emitter, from, direction.as_dvec3());
        let distance = if hit > 0.0 && hit < f64::INFINITY { hit } else { length };
        let cosine = if shines { cosine_of(surface, normal, direction) } else { 0.0 };
        let irradiance = irradiance_from_area(radiance, cosine, pdf);
        let ray = ShadowRay { origin, direction, distance, cosine };
        (LightRay { ray, t_max: shadow_t_max(distance), irradiance }, pdf)
    })
}
// ANCHOR_END: sample_light

/// Appends, for each row, a shadow ray to a point sampled on one of the area lights.
pub fn sample_area_lights(
    lights: Res<Shared<AreaLightTable>>,
    sampling: Res<Shared<SamplingTable>>,
    mut tiles: Query<(LightSamplingView, DrawsView, Option<&Paths>)>,
) {
    if lights.is_empty() {
        return;
    }
    for (LightSamplingViewItem { surfaces, shading, list, far, mut rays, mut pdfs }, draws, paths) in &mut tiles {
        let receivers = LightRows::new(surfaces, shading, list, far);
        let (draws, to) = (draws.draws(&sampling, paths), (&mut *rays, pdfs.as_deref_mut()));
        let (sample, key) = (draws.sample(), |row| draws.key(row));
        with_sampler!(sampling.sampler, D => {
            let drawn = [Purpose::LightChoice, Purpose::LightPoint].map(|purpose| D::of(sample, purpose));
            sample_rows(drawn, key, &lights, &receivers, to);
        });
    }
}

#[inline(always)]
fn sample_rows<D: Draw>(
    [choice, place]: [D; 2],
    key: impl Fn(usize) -> PixelKey,
    lights: &AreaLightTable,
    receivers: &LightRows<'_>,
    to: RayLists<'_>,
) {
    append_sampled(receivers, to, |row, surface, normal| {
        let key = key(row);
        sample_light(lights, choice.one(key), surface, normal, place.two(key).map(unit))
    });
}

/// The stage that runs [`sample_area_lights`]: next-event estimation, the alternative to BSDF sampling alone.
pub fn area_light_stage() -> Stage {
    Stage::new("Sample area lights", TileSystems::SampleLights, sample_area_lights)
        .kind(StageKind::Alternative)
        .appends::<ShadowRays>()
        .when(|scene| {
            area_light_evidence(scene).and(|| light_sampling_evidence(scene)).and(|| material_evidence(scene))
        })
}
