//! What principled surfaces add to single scattering, from averages over the hemisphere.

use super::*;
use pinhole::material::{ByCosine, ggx_brdf, multiple_scattering_albedo, single_scattering};
use pinhole::scene::Rgb;
use std::f64::consts::FRAC_1_PI;

const DIELECTRIC: f64 = 0.04;

/// The hemispherical average 2 ∫ f(μ) μ dμ by the midpoint rule.
fn average(of: impl Fn(f64) -> f64) -> f64 {
    const PARTS: u32 = 20_000;
    let part = |at: u32| {
        let cosine = (f64::from(at) + 0.5) / f64::from(PARTS);
        2.0 * cosine * of(cosine) / f64::from(PARTS)
    };
    (0..PARTS).map(part).sum()
}

fn schlick(normal: f64, cosine: f64) -> f64 {
    normal + (1.0 - normal) * (1.0 - cosine).powi(5)
}

/// The BSDF of a grey surface between two directions.
fn evaluated(grey: f64, metallic: f64, roughness: f64, [light, eye]: [DVec3; 2]) -> f64 {
    let mut world = World::new();
    world.spawn(Principled { base_colour: Rgb::grey(grey), metallic, roughness });
    let census = Census::of(&world);
    let table = census.table::<PrincipledTable>().expect("a table");
    Bsdf::eval(&*table, &Site::opaque(0, [grey; 3]), light, eye)[1]
}

/// What single scattering loses is scattered again, with the average of Schlick's reflectance.
#[test]
fn a_principled_metal_scatters_again_by_its_average_reflectance() {
    let [light, eye] = [DVec3::new(0.48, 0.6, 0.64), eye_at(40.0)];
    for (grey, roughness) in [(0.1, 0.9), (0.6, 0.7), (1.0, 1.0)] {
        let (alpha, facing) = (roughness * roughness, eye.dot((light + eye).normalize()));
        let lost = ByCosine::lost(alpha);
        let again = multiple_scattering_albedo(average(|cosine| schlick(grey, cosine)), lost.average());
        let several = again * lost.at(light.z) * lost.at(eye.z) / lost.average() * FRAC_1_PI;
        let expected = ggx_brdf(light, eye, alpha) * schlick(grey, facing) + several;
        let found = evaluated(grey, 1.0, roughness, [light, eye]);
        assert!((found / expected - 1.0).abs() < 1e-6, "{grey}, {roughness}: {found} for {expected}");
    }
}

/// Diffuse reflection is what specular reflection leaves at both directions, over the average of what it leaves.
#[test]
fn principled_diffuse_reflection_is_scaled_by_what_specular_reflection_leaves() {
    let [light, eye] = [DVec3::new(0.48, 0.6, 0.64), eye_at(70.0)];
    for roughness in [0.4, 0.8, 1.0] {
        let alpha = roughness * roughness;
        let lost = ByCosine::lost(alpha);
        let more = |cosine: f64| single_scattering(cosine, alpha, |at| schlick(0.0, at) - schlick(0.0, cosine));
        let more = ByCosine::new(alpha, more);
        let again = multiple_scattering_albedo(average(|cosine| schlick(DIELECTRIC, cosine)), lost.average());
        let left = |cosine: f64| {
            let grazing = schlick(0.0, cosine) * (1.0 - lost.at(cosine)) + more.at(cosine);
            let once = DIELECTRIC * (1.0 - lost.at(cosine)) + (1.0 - DIELECTRIC) * grazing;
            1.0 - once - again * lost.at(cosine)
        };
        let expected = left(light.z) * left(eye.z) / average(left) * FRAC_1_PI;
        let [white, black] = [1.0, 0.0].map(|grey| evaluated(grey, 0.0, roughness, [light, eye]));
        assert!(((white - black) / expected - 1.0).abs() < 1e-7, "{roughness}: {} for {expected}", white - black);
    }
}
