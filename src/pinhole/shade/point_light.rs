use super::LightRays;
use super::light::{shadow_ray_to, shadow_t_max};
use super::receivers::{LightRay, LightRows, RayLists, append_rays};
use super::view::{LightSamplingView, LightSamplingViewItem};
use crate::extract::{PointLightTable, material_evidence, unless_occlusion};
use crate::plan::{Evidence, Shared, Stage, TileSystems};
use crate::scene::PointLight;
use bevy_ecs::prelude::*;
use multiversion::multiversion;

// ANCHOR: irradiance_from_point
/// The irradiance from a point light of intensity I: I cos θ / d².
///
/// It decreases with the square of the distance and with the cosine of the angle of incidence.
#[inline(always)]
pub fn irradiance_from_point(intensity: [f64; 3], cosine: f64, distance_squared: f64) -> [f64; 3] {
    let weight = cosine / distance_squared;
    [intensity[0] * weight, intensity[1] * weight, intensity[2] * weight]
}
// ANCHOR_END: irradiance_from_point

/// Appends shadow rays to point lights, light after light.
pub fn sample_point_lights(lights: Res<Shared<PointLightTable>>, mut tiles: Query<LightSamplingView>) {
    for LightSamplingViewItem { surfaces, shading, list, far, mut rays, mut pdfs } in &mut tiles {
        let receivers = LightRows::new(surfaces, shading, list, far);
        for light in 0..lights.position.len() {
            sample_rows(&receivers, &lights, light, (&mut rays, pdfs.as_deref_mut()));
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn sample_rows(receivers: &LightRows<'_>, lights: &PointLightTable, light: usize, rays: RayLists<'_>) {
    let (position, intensity) = (lights.position[light], lights.intensity[light]);
    append_rays(receivers, rays, lights.casts_shadows[light], |surface, normal| {
        let ray = shadow_ray_to(surface, normal, position);
        let irradiance = irradiance_from_point(intensity, ray.cosine, ray.distance * ray.distance);
        LightRay { ray, t_max: shadow_t_max(ray.distance), irradiance }
    });
}

/// The stage that runs [`sample_point_lights`].
pub fn point_light_stage() -> Stage {
    Stage::new("Sample point lights", TileSystems::SampleLights, sample_point_lights).appends::<LightRays>().when(
        |scene| {
            unless_occlusion(scene, Evidence::of::<PointLight>(scene, "point light").and(|| material_evidence(scene)))
        },
    )
}
