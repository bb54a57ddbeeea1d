//! Lights and materials: highlights at any exponent, cones of any width, suns over scenes of any size.

use super::bench::Bench;
use super::{Group, Method, Tally, Trial, light_albedo};
use crate::measure::draws::Draws;
use crate::measure::exact::UNIT_ROUNDOFF_F32 as U;
use crate::measure::ray_aim::rounded_ray;
use crate::naive::light::{
    highlight_f32, lit_f32, spot_falloff_by_cosine, spot_falloff_by_cosine_f32, sun_as_a_far_light,
};
use glam::{DVec3, Vec3};
use pinhole::extract::{DirectionalLightTable, MaterialKind, MaterialTable, PointLightTable, SpotLightTable};
use pinhole::follow;
use pinhole::intersect::{MaterialRows, Surface, Surfaces};
use pinhole::lights::{
    PlacedDirectionalLight, PlacedPointLight, PlacedSpotLight, spot_falloff, versine, versine_of_half,
};
use pinhole::material::{BlinnPhongTable, MatteTable, PhongTable, highlight, mirror_cosine, phong_peak};
use pinhole::plan::VectorRows;
use pinhole::scene::Degrees;
use pinhole::shade::{self, Radiance, ShadowRays};
use pinhole::shapes::offset_bound;
use std::ops::Range;

const HIGHLIGHT: [Method; 2] = [
    Method::pinhole("pinhole, Phong in f64", "of its doubt", 1.0),
    Method::naive("naive, in f32", "of its doubt", 1.0),
];
const SPOT: [Method; 3] = [
    Method::pinhole("pinhole, by 1 - cos", "of the whole", 1e-8),
    Method::naive("naive, by cosines", "of the whole", 1e-8),
    Method::naive("naive, by cosines in f32", "of the whole", 1e-8),
];
const SUN: [Method; 2] =
    [Method::pinhole("pinhole, parallel rays", "u", 4.0), Method::naive("naive, a light 1e6 away", "u", 4.0)];
const LIGHT: [Method; 2] =
    [Method::pinhole("pinhole, all its stages", "", 0.0), Method::naive("naive, in f32", "", 0.0)];

/// The cases of the group.
pub fn trials() -> Vec<Trial> {
    let mut trials = light_albedo::trials();
    trials.extend([
        Trial::new(Group::Light, "highlights, exponents 1 to 1e9", &HIGHLIGHT, check_highlights),
        Trial::new(Group::Light, "edges of spots, 1e-4 to 179.99 degrees", &SPOT, check_spots),
        Trial::new(Group::Light, "the sun at places of 1e-8 to 1e8", &SUN, check_suns),
        Trial::new(Group::Light, "light is a number and not below 0, any accepted scene", &LIGHT, check_numbers),
    ]);
    trials
}

/// Directions of f32 about the middle of a highlight.
///
/// cos α by its sine, √(1 − sin²α), whose logarithm is ½ log1p(−sin²α): no digit of a small angle is lost.
/// A cosine near 1 is rounded by 2⁻⁵² or so, which n multiplies: that is the doubt that an answer may have.
fn check_highlights(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(HIGHLIGHT.len());
    for index in range {
        let mut draws = Draws::new(401, index);
        let exponent = draws.power_of_ten(0.0, 9.0);
        let normal = draws.unit_vector();
        let away = (normal + draws.unit_vector_across(normal) * draws.power_of_ten(-3.0, 1.0)).normalize();
        let mirrored = 2.0 * normal.dot(away) * normal - away;
        let off = draws.unit_vector_across(mirrored) * (draws.between(0.0, 4.0) / libm::sqrt(exponent));
        let [normal, to_light, to_eye] =
            [normal, away, mirrored + off].map(|direction| rounded_ray(Vec3::ZERO, direction).direction);
        let [n, l, v] = [normal, to_light, to_eye].map(|direction| direction.as_dvec3().normalize());
        let lobe = 2.0 * n.dot(l) * n - l;
        let sine_squared = lobe.cross(v).length_squared() / (lobe.length_squared() * v.length_squared());
        let ahead = lobe.dot(v) > 0.0 && sine_squared < 1.0;
        let exact = if ahead { libm::exp(0.5 * exponent * libm::log1p(-sine_squared)) } else { 0.0 };
        tally.count(ahead);
        let doubt = exponent * libm::ldexp(1.0, -48) + libm::ldexp(1.0, -46);
        let [n, l, v] = [normal, to_light, to_eye].map(Vec3::as_dvec3);
        let pinhole = highlight(phong_peak(exponent), exponent, mirror_cosine(n, l, v)) / phong_peak(exponent);
        tally.scores[0].measure((pinhole - exact).abs() / doubt);
        let naive = highlight_f32(1.0, exponent as f32, normal, to_light, to_eye);
        tally.scores[1].measure((f64::from(naive) - exact).abs() / doubt);
    }
    tally
}

/// Directions about the edges of cones; the angle by its tangent, |a × b| / a·b, is the oracle.
fn check_spots(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(SPOT.len());
    for index in range {
        let mut draws = Draws::new(402, index);
        let outer = if index % 4 == 0 { draws.between(100.0, 179.99) } else { draws.power_of_ten(-4.0, 2.0) };
        let inner = outer * [0.0, draws.unit(), 1.0 - draws.power_of_ten(-6.0, 0.0)][index as usize % 3];
        let edge = [inner, outer][index as usize / 3 % 2] * std::f64::consts::PI / 360.0;
        let angle = edge * (1.0 + draws.between(-1.0, 1.0) * draws.power_of_ten(-3.0, 0.0));
        let axis = draws.unit_vector().normalize();
        let across = draws.unit_vector_across(axis);
        let along = (axis * libm::cos(angle) + across * libm::sin(angle)).normalize();
        let true_angle = libm::atan2(axis.cross(along).length(), axis.dot(along));
        let half_sine = libm::sin(0.5 * true_angle);
        let [versine_inner, versine_outer] = [inner, outer].map(|angle| versine_of_half(Degrees(angle)));
        let s = ((versine_outer - 2.0 * half_sine * half_sine) / (versine_outer - versine_inner)).clamp(0.0, 1.0);
        let exact = s * s * (3.0 - 2.0 * s);
        tally.count(exact > 0.0 && exact < 1.0);
        // Where the two cones are nearly one, a direction's own rounding decides; what it can do is taken off.
        let doubt = 8.0 * f64::EPSILON * libm::sin(true_angle).max(f64::EPSILON) / (versine_outer - versine_inner);
        let off = |falloff: f64| ((falloff - exact).abs() - doubt).max(0.0);
        tally.scores[0].measure(off(spot_falloff(versine(along, axis), versine_inner, versine_outer)));
        let cosines = [axis.dot(along), libm::cos(inner * std::f64::consts::PI / 360.0), libm::cos(edge_of(outer))];
        tally.scores[1].measure(off(spot_falloff_by_cosine(cosines[0], cosines[1], cosines[2])));
        let [c, i, o] = cosines.map(|cosine| cosine as f32);
        tally.scores[2].measure(off(f64::from(spot_falloff_by_cosine_f32(c, i, o))));
    }
    tally
}

/// The angle from the axis to the edge of a cone that is so many degrees across.
fn edge_of(degrees: f64) -> f64 {
    degrees * std::f64::consts::PI / 360.0
}

/// Irradiance from a sun by pinhole's stage, against E cos θ.
fn check_suns(range: Range<u64>) -> Tally {
    let (mut tally, mut bench) =
        (Tally::new(SUN.len()), Bench::new(&[shade::start_shadow_rays_stage(), shade::directional_light_stage()]));
    bench.put(first_row());
    for index in range {
        let mut draws = Draws::new(403, index);
        let normal = draws.unit_vector().as_vec3();
        let position = (draws.unit_vector() * draws.power_of_ten(-8.0, 8.0)).as_vec3();
        let to_light = (normal.as_dvec3() * draws.unit() + draws.unit_vector_across(normal.as_dvec3())).normalize();
        let exact = normal.as_dvec3().dot(to_light);
        tally.count(exact > 0.0);
        if exact <= 0.0 {
            continue;
        }
        bench.put(surfaces(Surface {
            position,
            normal,
            bound: offset_bound(position.as_dvec3(), DVec3::ZERO, 0.0),
            material: 0,
        }));
        let sun = PlacedDirectionalLight { to_light, irradiance: [1.0; 3] };
        bench.insert(DirectionalLightTable { row: vec![sun], casts_shadows: vec![true], choice: None });
        bench.run();
        let rays = bench.column::<ShadowRays>();
        let (pinhole, t_max) =
            rays.irradiance[0].first().zip(rays.t_max.first()).map_or((0.0, f32::INFINITY), |(&r, &t_max)| (r, t_max));
        tally.scores[0].check(t_max == f32::INFINITY);
        tally.scores[0].measure((f64::from(pinhole) - exact).abs() / U);
        let naive = sun_as_a_far_light(1.0, to_light.as_vec3(), position, normal);
        tally.scores[1].measure((f64::from(naive.max(0.0)) - exact).abs() / U);
    }
    tally
}

/// Point lights, suns and spots of any strength at any distance on surfaces of every kind, by all stages together.
fn check_numbers(range: Range<u64>) -> Tally {
    let stages = [
        shade::start_shadow_rays_stage(),
        shade::point_light_stage(),
        shade::directional_light_stage(),
        shade::spot_light_stage(),
        follow::direct_light_stage::<MatteTable>(),
        follow::direct_light_stage::<PhongTable>(),
        follow::direct_light_stage::<BlinnPhongTable>(),
    ];
    let (mut tally, mut bench) = (Tally::new(LIGHT.len()), Bench::new(&stages));
    bench.put(first_row());
    for index in range {
        let mut draws = Draws::new(404, index);
        let exponent = [0.0, 1.0, draws.power_of_ten(0.0, 9.0), 1e9][index as usize % 4];
        let colour = [draws.unit(), 0.0, 1.0];
        let specular = [1.0 - colour[0], 1.0, 0.0];
        materials(&mut bench, exponent, colour, specular);
        let normal = draws.unit_vector().as_vec3();
        let position = (draws.unit_vector() * draws.power_of_ten(-18.0, 18.0)).as_vec3();
        let bound = offset_bound(position.as_dvec3(), DVec3::ZERO, 0.0);
        bench.put(surfaces(Surface { position, normal, bound, material: index as u32 % 3 }));
        let leaving = |draws: &mut Draws| {
            let along = draws.unit_vector_across(normal.as_dvec3());
            (along + normal.as_dvec3() * draws.power_of_ten(-12.0, 3.0)).normalize()
        };
        let (away, eye) = (leaving(&mut draws), leaving(&mut draws));
        // Often where the highlight is at its brightest.
        let mirrored = 2.0 * normal.as_dvec3().dot(away) * normal.as_dvec3() - away;
        let eye = rounded_ray(Vec3::ZERO, -(if index % 2 == 0 { mirrored } else { eye }));
        bench.aim(&[eye]);
        let intensity =
            [0.0, draws.power_of_ten(-45.0, 38.5), f64::from(f32::MAX)].map(|part: f64| part.min(f64::from(f32::MAX)));
        let light = position.as_dvec3() + away * draws.power_of_ten(-20.0, 18.0);
        lights(&mut bench, light, away, intensity);
        let mut black = Radiance::default();
        black.slices_mut(1);
        bench.put(black);
        bench.run();
        let rays = bench.column::<ShadowRays>();
        let radiance = bench.column::<Radiance>();
        tally.count(!rays.irradiance[0].is_empty());
        let sound = |part: f32| part >= 0.0;
        let brought = rays.irradiance[0].iter().chain(&rays.irradiance[1]).chain(&rays.irradiance[2]);
        tally.scores[0].check(brought.copied().all(|part| sound(part) && part.is_finite()));
        tally.scores[0].check(radiance.rgb.at(0).into_iter().all(sound));
        let direction = (light - position.as_dvec3()).as_vec3();
        let height =
            highlight_f32(phong_peak(exponent) as f32, exponent as f32, normal, away.as_vec3(), -eye.direction);
        tally.scores[1].check(intensity.iter().all(|&part| sound(lit_f32(part as f32, direction, normal, height))));
    }
    tally
}

/// A matte, a Phong and a Blinn–Phong material of these numbers.
fn materials(bench: &mut Bench, exponent: f64, colour: [f64; 3], specular: [f64; 3]) {
    let kind = vec![MaterialKind::Matte, MaterialKind::Phong, MaterialKind::BlinnPhong];
    bench.insert(MaterialTable::opaque(kind, vec![colour; 3]));
    let (specular, exponents) = (vec![specular], vec![exponent]);
    bench.insert(MatteTable);
    bench.insert(PhongTable::new(specular.clone(), exponents.clone()));
    bench.insert(BlinnPhongTable::new(specular, exponents));
}

/// One light of each kind, the spot's edge at the surface.
fn lights(bench: &mut Bench, position: DVec3, to_light: DVec3, strength: [f64; 3]) {
    let casts_shadows = vec![false];
    let point = PlacedPointLight { position, intensity: strength };
    bench.insert(PointLightTable { row: vec![point], casts_shadows: casts_shadows.clone(), choice: None });
    let spot = PlacedSpotLight { position, axis: -to_light, intensity: strength, inner: 0.0, outer: 1.0 };
    bench.insert(SpotLightTable { row: vec![spot], casts_shadows: casts_shadows.clone(), choice: None });
    let sun = PlacedDirectionalLight { to_light, irradiance: strength };
    bench.insert(DirectionalLightTable { row: vec![sun], casts_shadows, choice: None });
}

fn surfaces(surface: Surface) -> Surfaces {
    let mut surfaces = Surfaces::default();
    surfaces.slices_mut(1);
    surfaces.set(0, surface);
    surfaces
}

fn first_row() -> MaterialRows {
    let mut rows = MaterialRows::default();
    rows.slices_mut(1)[0] = 0;
    rows
}
