use super::light::{shadow_ray_to, shadow_t_max};
use super::receivers::{LightRay, LightRows, append_rays};
use super::view::{LightSamplingView, LightSamplingViewItem};
use super::{LightRays, irradiance_from_point};
use crate::extract::{SpotLightTable, material_evidence, unless_occlusion};
use crate::plan::{Evidence, Shared, Stage, TileSystems};
use crate::scene::SpotLight;
use bevy_ecs::prelude::*;
use glam::DVec3;

// ANCHOR: versine
/// 1 − cos of the angle between two unit vectors: half the squared distance between their tips.
///
/// In a narrow cone the cosine itself would lose the angle, since it is 1 but for its last digits.
#[inline(always)]
pub fn versine(a: DVec3, b: DVec3) -> f64 {
    0.5 * (a - b).length_squared()
}
// ANCHOR_END: versine

// ANCHOR: spot_falloff
/// The falloff of a spot light's intensity where 1 − cos θ is `versine`: 1 in the inner cone, 0 outside the outer one,
/// and 3s² − 2s³ in between, with s running from 0 at the outer edge to 1 at the inner.
///
/// It interpolates in 1 − cos θ, which is proportional to solid angle, so the light's power is πI(inner + outer).
#[inline(always)]
pub fn spot_falloff(versine: f64, inner: f64, outer: f64) -> f64 {
    let s = (outer - versine) / (outer - inner);
    if s >= 1.0 {
        1.0
    } else if s > 0.0 {
        s * s * (3.0 - 2.0 * s)
    } else {
        0.0
    }
}
// ANCHOR_END: spot_falloff

/// Appends shadow rays to spot lights, light after light; a surface outside the cone gets none.
pub fn sample_spot_lights(lights: Res<Shared<SpotLightTable>>, mut tiles: Query<LightSamplingView>) {
    for LightSamplingViewItem { surfaces, shading, list, far, mut rays, mut pdfs } in &mut tiles {
        let receivers = LightRows::new(surfaces, shading, list, far);
        for (light, &position) in lights.position.iter().enumerate() {
            let (axis, inner, outer) = (lights.axis[light], lights.inner[light], lights.outer[light]);
            append_rays(
                &receivers,
                (&mut rays, pdfs.as_deref_mut()),
                lights.casts_shadows[light],
                |surface, normal| {
                    let mut ray = shadow_ray_to(surface, normal, position);
                    // A direction in f32 is too coarse for narrow cones.
                    let along = (ray.origin.as_dvec3() - position) * (1.0 / ray.distance);
                    let falloff = spot_falloff(versine(along, axis), inner, outer);
                    let intensity = lights.intensity[light].map(|part| part * falloff);
                    let irradiance = irradiance_from_point(intensity, ray.cosine, ray.distance * ray.distance);
                    ray.cosine = if falloff > 0.0 { ray.cosine } else { 0.0 };
                    LightRay { ray, t_max: shadow_t_max(ray.distance), irradiance }
                },
            );
        }
    }
}

/// The stage that runs [`sample_spot_lights`].
pub fn spot_light_stage() -> Stage {
    Stage::new("Sample spot lights", TileSystems::SampleLights, sample_spot_lights).appends::<LightRays>().when(
        |scene| {
            unless_occlusion(scene, Evidence::of::<SpotLight>(scene, "spot light").and(|| material_evidence(scene)))
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extract::versine_of_half;
    use crate::measure::hemisphere::Quadrature;
    use crate::scene::Degrees;
    use std::f64::consts::{PI, TAU};

    /// The power received by a sphere around a spot light, by quadrature, is the light's power at any radius.
    #[test]
    fn a_sphere_around_a_spot_receives_its_whole_power() {
        let quadrature = Quadrature::default();
        let mut tried = 0;
        for (inner, outer) in [(0.0, 1e-4), (1e-4, 1e-4), (20.0, 35.0), (0.0, 180.0), (179.0, 179.99), (180.0, 180.0)] {
            let [inner, outer] = [inner, outer].map(|angle| versine_of_half(Degrees(angle)));
            for radius in [1e-8, 0.3, 1e8] {
                // Rings of equal area: dA = 2π r² dv, v = 1 − cos θ.
                let received = |v: f64| {
                    let intensity = [spot_falloff(v, inner, outer), 0.0, 0.0];
                    irradiance_from_point(intensity, 1.0, radius * radius)[0] * TAU * radius * radius
                };
                let sum = quadrature.sum_of_panels(&[0.0, inner, outer, 2.0], received);
                let power = PI * (inner + outer);
                assert!((sum / power - 1.0).abs() < 1e-12, "{inner} {outer} {radius}: {sum} for {power}");
                tried += 1;
            }
        }
        eprintln!("spots: {tried} spheres receive a spot light's whole power");
    }

    #[test]
    fn edges_are_where_the_angles_say() {
        for outer in [1e-4, 1.0, 90.0, 179.99] {
            let edges = [outer * 0.5, outer].map(|angle| versine_of_half(Degrees(angle)));
            let at = |fraction: f64| {
                let angle = Degrees(outer * fraction).radians() / 2.0;
                let direction = DVec3::new(libm::sin(angle), 0.0, libm::cos(angle));
                spot_falloff(versine(direction, DVec3::Z), edges[0], edges[1])
            };
            assert_eq!([at(0.0), at(0.49), at(1.000_001)], [1.0, 1.0, 0.0], "outer {outer}");
            let fading = [0.51, 0.6, 0.75, 0.9, 0.99].map(at);
            assert!(fading.windows(2).all(|pair| pair[0] > pair[1] && pair[1] > 0.0 && pair[0] < 1.0), "{fading:?}");
        }
        assert_eq!([0.1, 0.5, 0.6].map(|v| spot_falloff(v, 0.5, 0.5)), [1.0, 0.0, 0.0], "a sharp edge");
    }
}
