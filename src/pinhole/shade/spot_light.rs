use super::light::{LightRay, LightRows, aim, append_rays, shadow_t_max};
use super::{LightPdfs, LightRays, irradiance_from_point};
use crate::extract::{SpotLightTable, material_evidence, unless_occlusion};
use crate::intersect::{MaterialRows, ShadingNormals, Surfaces};
use crate::plan::{Evidence, Shared, Stage, TileSystems};
use crate::scene::SpotLight;
use bevy_ecs::prelude::*;
use glam::DVec3;

// ANCHOR: versine
/// 1 − cos of the angle between two unit vectors: half the square of what lies between their tips.
///
/// The cosine itself would lose the angle in a narrow cone, where it is 1 but for its last digits.
#[inline(always)]
pub fn versine(a: DVec3, b: DVec3) -> f64 {
    0.5 * (a - b).length_squared()
}
// ANCHOR_END: versine

// ANCHOR: spot_share
/// The share of a spot light's intensity that is left where 1 − cos θ is `versine`: 1 in the inner cone, 0 beyond the
/// outer one, 3s² − 2s³ between, with s the share of the way from the outer edge to the inner.
///
/// All sharing is in 1 − cos, so the solid angle is shared evenly, and the light's whole power is πI(inner + outer).
#[inline(always)]
pub fn spot_share(versine: f64, inner: f64, outer: f64) -> f64 {
    let s = (outer - versine) / (outer - inner);
    if s >= 1.0 {
        1.0
    } else if s > 0.0 {
        s * s * (3.0 - 2.0 * s)
    } else {
        0.0
    }
}
// ANCHOR_END: spot_share

/// Appends a tile's rays to spot lights, light after light; a surface outside the cone gets none.
pub fn sample_spot_lights(
    lights: Res<Shared<SpotLightTable>>,
    mut tiles: Query<(&Surfaces, Option<&ShadingNormals>, &MaterialRows, &mut LightRays, Option<&mut LightPdfs>)>,
) {
    for (surfaces, shading, list, mut rays, mut pdfs) in &mut tiles {
        let lit = LightRows { surfaces, shading, rows: &list.row };
        for (light, &position) in lights.position.iter().enumerate() {
            let (axis, inner, outer) = (lights.axis[light], lights.inner[light], lights.outer[light]);
            append_rays(&lit, (&mut rays, pdfs.as_deref_mut()), lights.casts_shadows[light], |surface, normal| {
                let mut aimed = aim(surface, normal, position);
                // The direction of f32 is too coarse for narrow cones.
                let along = (aimed.origin.as_dvec3() - position) * (1.0 / aimed.distance);
                let share = spot_share(versine(along, axis), inner, outer);
                let intensity = lights.intensity[light].map(|part| part * share);
                let irradiance = irradiance_from_point(intensity, aimed.cosine, aimed.distance * aimed.distance);
                aimed.cosine = if share > 0.0 { aimed.cosine } else { 0.0 };
                LightRay { aimed, reach: shadow_t_max(aimed.distance), irradiance }
            });
        }
    }
}

/// The stage on offer.
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

    /// What a sphere around a spot receives in all, summed by quadrature, is the light's whole power at any radius.
    #[test]
    fn a_sphere_around_a_spot_receives_its_whole_power() {
        let quadrature = Quadrature::default();
        let mut tried = 0;
        for (inner, outer) in [(0.0, 1e-4), (1e-4, 1e-4), (20.0, 35.0), (0.0, 180.0), (179.0, 179.99), (180.0, 180.0)] {
            let [inner, outer] = [inner, outer].map(|angle| versine_of_half(Degrees(angle)));
            for radius in [1e-8, 0.3, 1e8] {
                // Rings of equal area: dA = 2π r² dv, v = 1 − cos θ.
                let received = |v: f64| {
                    let intensity = [spot_share(v, inner, outer), 0.0, 0.0];
                    irradiance_from_point(intensity, 1.0, radius * radius)[0] * TAU * radius * radius
                };
                let sum = quadrature.sum_of_panels(&[0.0, inner, outer, 2.0], received);
                let power = PI * (inner + outer);
                assert!((sum / power - 1.0).abs() < 1e-12, "{inner} {outer} {radius}: {sum} for {power}");
                tried += 1;
            }
        }
        eprintln!("spots: {tried} spheres receive a spot's whole power");
    }

    #[test]
    fn edges_are_where_the_angles_say() {
        for outer in [1e-4, 1.0, 90.0, 179.99] {
            let edges = [outer * 0.5, outer].map(|angle| versine_of_half(Degrees(angle)));
            let at = |share: f64| {
                let angle = Degrees(outer * share).radians() / 2.0;
                let way = DVec3::new(libm::sin(angle), 0.0, libm::cos(angle));
                spot_share(versine(way, DVec3::Z), edges[0], edges[1])
            };
            assert_eq!([at(0.0), at(0.49), at(1.000_001)], [1.0, 1.0, 0.0], "outer {outer}");
            let fading = [0.51, 0.6, 0.75, 0.9, 0.99].map(at);
            assert!(fading.windows(2).all(|pair| pair[0] > pair[1] && pair[1] > 0.0 && pair[0] < 1.0), "{fading:?}");
        }
        assert_eq!([0.1, 0.5, 0.6].map(|v| spot_share(v, 0.5, 0.5)), [1.0, 0.0, 0.0], "a sharp edge");
    }
}
