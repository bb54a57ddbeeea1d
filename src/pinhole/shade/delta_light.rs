//! One stage for each registered light without an area: a shadow ray from each surface to each of its lights, or to one
//! chosen of many.

use super::ShadowRays;
use super::light::{ShadowRay, cosine_of, shadow_t_max};
use super::radiance::{LightSamplingView, LightSamplingViewItem};
use super::receivers::{LightRay, LightRows, MakesRays, RayLists, append_rays, append_sampled, is_apart};
use crate::each::Each;
use crate::extract::{
    LightChoice, LightsOf, SamplingTable, lights_evidence, many_lights_evidence, material_evidence, unless_occlusion,
};
use crate::intersect::Surface;
use crate::lights::{
    Light, LightVisitor, ListedLight, PlacedDirectionalLight, PlacedPointLight, PlacedSpotLight, Receiver, visit_lights,
};
use crate::plan::{Shared, Stage, TileSystems};
use crate::rays::{DrawsView, Paths};
use crate::sample::{Draw, Purpose, with_sampler};
use crate::shapes::offset_origin;
use bevy_ecs::prelude::*;
use glam::DVec3;
use multiversion::multiversion;
use std::any::TypeId;

// ANCHOR: shadow_ray_to
impl<L: Light> MakesRays for L {
    /// The shadow ray to a light, and the irradiance that it brings if it is not blocked.
    #[inline(always)]
    fn ray_from(&self, surface: &Surface, normal: DVec3, _: [f64; 2], _: DVec3) -> LightRay {
        let origin = offset_origin(surface.position, surface.normal, surface.bound);
        let sample = self.sample(origin.as_dvec3());
        let cosine = cosine_of(surface, normal, sample.direction);
        let irradiance = L::irradiance(&sample, cosine);
        let [r, g, b] = sample.strength.each(|part| part != 0.0);
        let ray = ShadowRay {
            origin,
            direction: sample.direction,
            distance: sample.distance,
            cosine: if r | g | b { cosine } else { 0.0 },
        };
        LightRay { ray, t_max: shadow_t_max(sample.distance), irradiance, pdf: 0.0 }
    }
}
// ANCHOR_END: shadow_ray_to

/// Appends shadow rays to all lights of one kind, light after light; where there are many, each surface sends a ray to
/// one that is chosen at random.
pub fn sample_lights<L: ListedLight>(
    lights: Res<Shared<LightsOf<L>>>,
    sampling: Option<Res<Shared<SamplingTable>>>,
    mut tiles: Query<(LightSamplingView, DrawsView, Option<&Paths>)>,
) {
    for (LightSamplingViewItem { surfaces, shading, list, far, mut rays, mut pdfs }, draws, paths) in &mut tiles {
        let receivers = LightRows::new(surfaces, shading, list, far);
        if let (Some(choice), Some(sampling)) = (&lights.choice, &sampling) {
            let (draws, to) = (draws.draws(sampling, paths), (&mut *rays, pdfs.as_deref_mut()));
            with_sampler!(sampling.sampler, D => {
                let drawn = D::of(draws.sample(), Purpose::DeltaLightChoice);
                append_sampled(&receivers, to, |row, surface, normal| {
                    chosen_ray(&lights, choice, drawn.one(draws.key(row)), surface, normal)
                });
            });
            continue;
        }
        for (light, &casts_shadows) in lights.row.iter().zip(&lights.casts_shadows) {
            sample_rows(&receivers, light, casts_shadows, (&mut rays, pdfs.as_deref_mut()));
        }
    }
}

/// The shadow ray to one light chosen of many; its irradiance is divided by the probability of the choice.
#[inline(always)]
fn chosen_ray<L: ListedLight>(
    lights: &LightsOf<L>,
    choice: &LightChoice,
    fraction: u32,
    surface: &Surface,
    normal: DVec3,
) -> LightRay {
    let origin = offset_origin(surface.position, surface.normal, surface.bound);
    let receiver = Receiver { position: origin.as_dvec3(), normal: surface.normal.as_dvec3(), depth: 0 };
    let (light, probability) = choice.choose(&receiver, fraction);
    let mut light_ray = lights.row[light].ray_from(surface, normal, [0.0; 2], DVec3::ZERO);
    light_ray.irradiance = light_ray.irradiance.each(|part| part / probability);
    if !lights.casts_shadows[light] {
        light_ray.t_max = 0.0;
    }
    if !is_apart(&light_ray.ray) {
        light_ray.ray.cosine = 0.0;
    }
    light_ray
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn sample_rows<L: Light>(receivers: &LightRows<'_>, light: &L, casts_shadows: bool, rays: RayLists<'_>) {
    let light = light.clone();
    append_rays(receivers, rays, casts_shadows, &light, [&[], &[]]);
}

/// The stage that runs [`sample_lights`].
pub fn light_sampling_stage<L: ListedLight>() -> Stage {
    Stage::new(L::NAMES.sample, TileSystems::SampleLights, sample_lights::<L>)
        .appends::<ShadowRays>()
        .table_where::<SamplingTable>(many_lights_evidence::<L>)
        .when(|scene| unless_occlusion(scene, lights_evidence::<L>(scene).and(|| material_evidence(scene))))
}

/// The stage that samples point lights.
pub fn point_light_stage() -> Stage {
    light_sampling_stage::<PlacedPointLight>()
}

/// The stage that samples directional lights.
pub fn directional_light_stage() -> Stage {
    light_sampling_stage::<PlacedDirectionalLight>()
}

/// The stage that samples spot lights.
pub fn spot_light_stage() -> Stage {
    light_sampling_stage::<PlacedSpotLight>()
}

/// The stages that sample each registered light with a position or each without, and whether it is the point light, with
/// which direct light is introduced.
pub fn light_sampling_stages(is_distant: bool) -> Vec<(bool, fn() -> Stage)> {
    struct Collected(bool, Vec<(bool, fn() -> Stage)>);
    impl LightVisitor for Collected {
        fn visit<L: ListedLight>(&mut self) {
            if L::IS_DISTANT == self.0 {
                self.1.push((TypeId::of::<L>() == TypeId::of::<PlacedPointLight>(), light_sampling_stage::<L>));
            }
        }
    }
    let mut collected = Collected(is_distant, Vec::new());
    visit_lights(&mut collected);
    collected.1
}
