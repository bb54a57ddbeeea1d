use super::LightRays;
use super::light::{ShadowRay, cosine_of};
use super::receivers::{LightRay, LightRows, append_rays};
use super::view::{LightSamplingView, LightSamplingViewItem};
use crate::extract::{DirectionalLightTable, material_evidence, unless_occlusion};
use crate::intersect::Surface;
use crate::plan::{Evidence, Shared, Stage, TileSystems};
use crate::scene::DirectionalLight;
use crate::shapes::offset_origin;
use bevy_ecs::prelude::*;
use glam::DVec3;

// ANCHOR: irradiance_from_direction
/// The irradiance from a light with parallel rays: E cos θ, at any distance.
#[inline(always)]
pub fn irradiance_from_direction(irradiance: [f64; 3], cosine: f64) -> [f64; 3] {
    [irradiance[0] * cosine, irradiance[1] * cosine, irradiance[2] * cosine]
}
// ANCHOR_END: irradiance_from_direction

/// The shadow ray along parallel light; nothing is beyond such a light.
#[inline(always)]
fn shadow_ray_along(surface: &Surface, normal: DVec3, to_light: DVec3) -> ShadowRay {
    let origin = offset_origin(surface.position, surface.normal, surface.bound);
    let direction = to_light.as_vec3();
    ShadowRay { origin, direction, distance: f64::INFINITY, cosine: cosine_of(surface, normal, direction) }
}

/// Appends shadow rays to directional lights, light after light; they have no end.
pub fn sample_directional_lights(lights: Res<Shared<DirectionalLightTable>>, mut tiles: Query<LightSamplingView>) {
    for LightSamplingViewItem { surfaces, shading, list, far, mut rays, mut pdfs } in &mut tiles {
        let receivers = LightRows::new(surfaces, shading, list, far);
        for (light, &irradiance) in lights.irradiance.iter().enumerate() {
            append_rays(
                &receivers,
                (&mut rays, pdfs.as_deref_mut()),
                lights.casts_shadows[light],
                |surface, normal| {
                    let ray = shadow_ray_along(surface, normal, lights.to_light[light]);
                    let irradiance = irradiance_from_direction(irradiance, ray.cosine);
                    LightRay { ray, t_max: f32::INFINITY, irradiance }
                },
            );
        }
    }
}

/// The stage that runs [`sample_directional_lights`].
pub fn directional_light_stage() -> Stage {
    Stage::new("Sample directional lights", TileSystems::SampleLights, sample_directional_lights)
        .appends::<LightRays>()
        .when(|scene| {
            unless_occlusion(
                scene,
                Evidence::of::<DirectionalLight>(scene, "directional light").and(|| material_evidence(scene)),
            )
        })
}
