use super::emitter::{distance_to, pdf_towards, point_on};
use super::light::{LightRay, LightRows, RayLists, ShadowRay, append_chosen, cosine_of, shadow_t_max};
use super::{LightPdfs, LightRays};
use crate::extract::{AreaLightTable, SamplingTable, area_light_evidence, light_sampling_evidence, material_evidence};
use crate::intersect::{MaterialRows, ShadingNormals, Surface, Surfaces, offset_origin};
use crate::plan::{Shared, Stage, StageKind, TileSystems};
use crate::rays::{Depth, Paths, PixelSamples, SampleNumber, Tile, pixel_of_row};
use crate::sample::{Draw, Independent, PixelKey, Purpose, Sobol, Stratified, unit};
use crate::scene::Sampler;
use bevy_ecs::prelude::*;
use glam::DVec3;

// ANCHOR: irradiance_from_area
/// What a surface receives of a light of radiance L, told by one direction to it: L cos θ / p.
///
/// p is how likely that direction was to be chosen, per unit of solid angle: the mean of many such tellings is the
/// integral of L cos θ over the directions that the light fills.
#[inline(always)]
pub fn irradiance_from_area(radiance: [f64; 3], cosine: f64, pdf: f64) -> [f64; 3] {
    let share = cosine / pdf;
    [radiance[0] * share, radiance[1] * share, radiance[2] * share]
}
// ANCHOR_END: irradiance_from_area

/// How likely a point on a light was to be aimed at from another, in 1/sr, the chance of choosing that light included; 0
/// from where the light does not shine.
///
/// `from` is where a ray starts that has met the light at `at`.
#[inline(always)]
pub fn area_light_pdf(lights: &AreaLightTable, light: usize, from: DVec3, at: DVec3) -> f64 {
    let emitter = &lights.emitter[light];
    let shines = !lights.one_sided[light] || emitter.faces(from);
    if shines { lights.random[light] * pdf_towards(emitter, from, at) } else { 0.0 }
}

// ANCHOR: sample_light
/// Aims at a point of a light, and says how likely that was.
///
/// The ray goes where its rounded direction leads, so its end is sought anew on the light along that: else a light met at a
/// slant would stand in its own way.
#[inline(always)]
fn sample_light(
    lights: &AreaLightTable,
    light: usize,
    surface: &Surface,
    normal: DVec3,
    u: [f64; 2],
) -> (LightRay, f64) {
    let origin = offset_origin(surface.position, surface.normal, surface.bound);
    let (from, emitter) = (origin.as_dvec3(), &lights.emitter[light]);
    let point = point_on(emitter, from, u);
    let pdf = lights.random[light] * point.pdf;
    let shines = pdf > 0.0 && (!lights.one_sided[light] || emitter.faces(from));

    let length = point.to.length();
    let direction = (point.to * (1.0 / length)).as_vec3();
    let met = distance_to(emitter, from, direction.as_dvec3());
    let distance = if met > 0.0 && met < f64::INFINITY { met } else { length };
    let cosine = if shines { cosine_of(surface, normal, direction) } else { 0.0 };
    let irradiance = irradiance_from_area(lights.radiance[light], cosine, pdf);
    let aimed = ShadowRay { origin, direction, distance, cosine };
    (LightRay { aimed, reach: shadow_t_max(distance), irradiance }, pdf)
}
// ANCHOR_END: sample_light

/// Appends, for each row, a ray to a point on one of the lights with an area.
pub fn sample_area_lights(
    lights: Res<Shared<AreaLightTable>>,
    sampling: Res<Shared<SamplingTable>>,
    mut tiles: Query<(
        (&Tile, Option<&SampleNumber>, Option<&Depth>, Option<&PixelSamples>, Option<&Paths>),
        (&Surfaces, Option<&ShadingNormals>, &MaterialRows),
        &mut LightRays,
        Option<&mut LightPdfs>,
    )>,
) {
    if lights.emitter.is_empty() {
        return;
    }
    for ((tile, number, depth, samples, paths), (surfaces, shading, list), mut rays, mut pdfs) in &mut tiles {
        let lit = LightRows { surfaces, shading, rows: &list.row };
        let key = |row| PixelKey::new(sampling.seed, pixel_of_row(tile, samples, paths, row));
        let (number, depth) = (number.map_or(0, |number| number.0), depth.map_or(0, |depth| depth.0));
        let to = (&mut *rays, pdfs.as_deref_mut());
        let purposes = [Purpose::LightChoice, Purpose::LightPoint];
        match sampling.sampler {
            Sampler::Independent => {
                aim_rows(purposes.map(|purpose| Independent::new(number, depth, purpose)), key, &lights, &lit, to);
            }
            Sampler::Stratified => {
                let all = sampling.samples;
                aim_rows(purposes.map(|purpose| Stratified::new(number, all, depth, purpose)), key, &lights, &lit, to);
            }
            Sampler::Sobol => {
                aim_rows(purposes.map(|purpose| Sobol::new(number, depth, purpose)), key, &lights, &lit, to);
            }
        }
    }
}

#[inline(always)]
fn aim_rows<D: Draw>(
    [choice, place]: [D; 2],
    key: impl Fn(usize) -> PixelKey,
    lights: &AreaLightTable,
    lit: &LightRows<'_>,
    to: RayLists<'_>,
) {
    append_chosen(lit, to, |row, surface, normal| {
        let key = key(row);
        let light = lights.chosen(choice.one(key));
        sample_light(lights, light, surface, normal, place.two(key).map(unit))
    });
}

/// The stage on offer: the alternative to meeting such light by chance.
pub fn area_light_stage() -> Stage {
    Stage::new("Sample area lights", TileSystems::SampleLights, sample_area_lights)
        .kind(StageKind::Alternative)
        .appends::<LightRays>()
        .when(|scene| {
            area_light_evidence(scene).and(|| light_sampling_evidence(scene)).and(|| material_evidence(scene))
        })
}
