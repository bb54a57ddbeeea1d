//! What principled surfaces add to single scattering, from averages over the hemisphere.

use super::*;
use pinhole::material::{ByCosine, Parameters, ggx_brdf, ggx_sample, multiple_scattering_albedo, single_scattering};
use pinhole::plan::Table;
use pinhole::sample::DiskPoint;
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
    world.spawn(Principled { base_colour: Rgb::grey(grey), metallic, roughness, ..Principled::default() });
    let census = Census::of(&world);
    let table = census.table::<PrincipledTable>().expect("a table");
    Bsdf::eval(&*table, &ShadingContext::opaque(0, Parameters { colour: [grey; 3], metallic, roughness }), light, eye)
        [1]
}

/// Of a black base only specular reflection is left, which at normal incidence is ((n − 1)/(n + 1))².
#[test]
fn a_principled_dielectric_reflects_by_its_index() {
    let up = DVec3::Z;
    for (ior, expected) in [(1.0, 0.0), (1.5, 0.04), (2.0, 1.0 / 9.0), (2.5, 9.0 / 49.0), (1e9, 1.0)] {
        let mut world = World::new();
        world.spawn(Principled {
            base_colour: Rgb::BLACK,
            metallic: 0.0,
            roughness: 0.1,
            ior,
            ..Principled::default()
        });
        let table = Census::of(&world).table::<PrincipledTable>().expect("a table");
        let context = ShadingContext::opaque(0, Parameters { roughness: 0.1, ..Parameters::default() });
        let reflected = Bsdf::eval(&*table, &context, up, up)[1] / ggx_brdf(up, up, 0.01);
        assert!((reflected - expected).abs() < 1e-3, "{ior}: {reflected} for {expected}");
    }
}

/// A thousand materials that are equally rough take little more than one.
#[test]
fn the_energies_of_equal_roughnesses_are_there_once() {
    let bytes = |roughness: &dyn Fn(u32) -> f64| {
        let mut world = World::new();
        for number in 0..100 {
            world.spawn(Principled { roughness: roughness(number), ..Principled::default() });
        }
        Table::bytes(&*Census::of(&world).table::<PrincipledTable>().expect("a table"))
    };
    let [alike, different] = [bytes(&|_| 0.5), bytes(&|number| 0.2 + 0.005 * f64::from(number))];
    assert!(10 * alike < different, "{alike} and {different}");
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

/// The albedo of a white metal whose roughness an image gives, without sampling it: single scattering by a lattice of
/// microfacets, and the rest, which depends on the cosines only, by the midpoint rule over the steps of the tables.
#[test]
fn a_mapped_white_metal_loses_nothing_however_smooth() {
    const LATTICE: [u64; 2] = [28_657, 17_711];
    const PARTS: u32 = 20_000;
    let mut world = World::new();
    world.spawn((Principled::default(), MetallicRoughnessMap::default()));
    let table = Census::of(&world).table::<PrincipledTable>().expect("a table");
    let mut worst = 0.0_f64;
    for roughness in [0.035, 0.05, 0.07, 0.085, 0.12, 0.26, 0.5, 1.0] {
        let (alpha, metallic) = (roughness * roughness, 1.0);
        let context = ShadingContext::opaque(0, Parameters { colour: [1.0; 3], metallic, roughness });
        for angle in ANGLES {
            let eye = eye_at(angle);
            let weight = |at: u64| {
                let s = (at as f64 + 0.5) / LATTICE[0] as f64;
                let turn = (at * LATTICE[1] % LATTICE[0]) as f64 / LATTICE[0] as f64;
                // Steep microfacets get most of the points.
                let sample = ggx_sample(eye, alpha, DiskPoint::polar(1.0 - s * s * s, turn));
                sample.map_or(0.0, |sample| 3.0 * s * s * sample.weight / LATTICE[0] as f64)
            };
            let once: f64 = (0..LATTICE[0]).map(weight).sum();
            let cosine = |x: f64| x * alpha / (1.0 + alpha - x);
            let part = |at: u32| {
                let [low, high] = [at, at + 1].map(|end| cosine(f64::from(end) / f64::from(PARTS)));
                let up = 0.5 * (low + high);
                let light = DVec3::new(0.0, (1.0 - up * up).sqrt(), up);
                let rest = Bsdf::eval(&*table, &context, light, eye)[1] - ggx_brdf(light, eye, alpha);
                2.0 * std::f64::consts::PI * rest * up * (high - low)
            };
            let albedo = once + (0..PARTS).map(part).sum::<f64>();
            worst = worst.max((albedo - 1.0).abs());
            assert!((albedo - 1.0).abs() < 3e-3, "{roughness} at {angle}°: {albedo}");
        }
    }
    eprintln!("mapped white metals: the worst albedo is {worst:.1e} from 1");
}

/// Where an image gives metallic and roughness, the surface is that of a material with these numbers, however its own
/// are.
///
/// At a roughness that has a table of its own the two are the same but for rounding.
/// In between, the BSDFs differ by the interpolation and by the tables' own quadrature of 610 points, each some 2 % of
/// the fraction lost where little is, which shows where one direction is at grazing incidence.
/// The bound is for these directions; between the tables' own cosines the worst pair may differ by more.
#[test]
fn a_mapped_surface_is_that_of_its_numbers() {
    let smoothest = 0.001_f64.sqrt().sqrt();
    let tabulated = |unit: f64| {
        let root = smoothest + (1.0 - smoothest) * (unit * 49.0).floor() / 48.0;
        root * root
    };
    assert_mapped("tabulated", tabulated, [1e-9, 1e-9]);
    assert_mapped("in between", |unit| unit, [0.03, 2e-3]);
}

/// Compares the BSDFs and the pdfs of surfaces that an image and the material give the same numbers.
fn assert_mapped(name: &str, roughness_of: impl Fn(f64) -> f64, max: [f64; 2]) {
    let mut world = World::new();
    world.spawn((
        Principled { metallic: 0.9, roughness: 0.1, ..Principled::default() },
        MetallicRoughnessMap::default(),
    ));
    let table = Census::of(&world).table::<PrincipledTable>().expect("a table");
    let (mut tried, mut worst) = (0, [0.0_f64; 2]);
    for index in 0..120 {
        let mut draws = Draws::new(3401, index);
        let (grey, metallic, roughness) = (draws.unit(), draws.unit(), roughness_of(draws.unit()));
        let mut other = World::new();
        other.spawn(Principled { base_colour: Rgb::grey(grey), metallic, roughness, ..Principled::default() });
        let own = Census::of(&other).table::<PrincipledTable>().expect("a table");
        let context = ShadingContext::opaque(0, Parameters { colour: [grey; 3], metallic, roughness });
        for _ in 0..50 {
            let (light, eye) = (direction(&mut draws, false), direction(&mut draws, false));
            let values = [&*table, &*own]
                .map(|table| [Bsdf::eval(table, &context, light, eye)[1], Bsdf::pdf(table, &context, light, eye)]);
            for part in [0, 1] {
                let [found, expected] = values.map(|values| values[part]);
                // Relative, but where almost nothing is reflected.
                worst[part] = worst[part].max((found - expected).abs() / expected.max(0.01));
            }
            tried += 1;
        }
    }
    let [bsdf, pdf] = worst;
    eprintln!("mapped surfaces, {name}: {tried} pairs of directions, BSDFs apart by {bsdf:.1e}, pdfs by {pdf:.1e}");
    assert!(worst[0] < max[0] && worst[1] < max[1], "{name}: {worst:?}");
}
