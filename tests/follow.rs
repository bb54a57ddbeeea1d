//! Light that is followed, held against what is known of it.
//!
//! Pictures are compared by means of few samples, enough for the resolution that is asked for here;
//! `PINHOLE_TEST_SAMPLES=16 cargo test --release --test renderer follow -- --nocapture` takes 16 times as many and says
//! what it tells apart.

#[path = "follow/accepted.rs"]
mod accepted;
#[path = "follow/bidirectional.rs"]
mod bidirectional;
#[path = "follow/broken.rs"]
mod broken;
#[path = "follow/bsdfs.rs"]
mod bsdfs;
#[path = "follow/caustics.rs"]
mod caustics;
#[path = "follow/dispersion.rs"]
mod dispersion;
#[path = "follow/distant.rs"]
mod distant;
#[path = "follow/far.rs"]
mod far;
#[path = "follow/foretold.rs"]
mod foretold;
#[path = "follow/frusta.rs"]
mod frusta;
#[path = "follow/in_media.rs"]
mod in_media;
#[path = "follow/inside.rs"]
mod inside;
#[path = "follow/leaning.rs"]
mod leaning;
#[path = "follow/light_paths.rs"]
mod light_paths;
#[path = "follow/long_paths.rs"]
mod long_paths;
#[path = "follow/many_lights.rs"]
mod many_lights;
#[path = "follow/material_maps.rs"]
mod material_maps;
#[path = "follow/materials.rs"]
mod materials;
#[path = "follow/nested.rs"]
mod nested;
#[path = "follow/non_opaque.rs"]
mod non_opaque;
#[path = "follow/normal_maps.rs"]
mod normal_maps;
#[path = "follow/numerics.rs"]
mod numerics;
#[path = "follow/photons.rs"]
mod photons;
#[path = "follow/preflight.rs"]
mod preflight;
#[path = "follow/sky.rs"]
mod sky;
use crate::scenes;

use bevy_ecs::prelude::*;
use pinhole::Overrides;
use pinhole::extract::integrator_of;
use pinhole::plan::{Census, Stage};
use pinhole::render::{Execution, render};
use pinhole::scene::{Background, Gradient, Integrator, LightStrategy, Resolution, Rgb, Sampler, Sampling};
use pinhole_lab::measure::closed_form::closed_forms;
use pinhole_lab::measure::image_error::Numbers;
use pinhole_lab::report::agreement::{Agreement, agreement};
use pinhole_lab::report::run::numbers;
use scenes::public::public;
use scenes::{named, offer, unhurried};

#[test]
fn closed_forms_hold() {
    let (mut forms, mut exact, mut tried) = (0, 0, 0);
    for form in closed_forms() {
        let (truth, measured) = ((form.truth)(), form.measure(form.few, 5).expect("measured"));
        let off = measured.deviation(truth);
        eprintln!(
            "{:<46} {:.5} ± {:.5} for {truth:.5}: {off:+.1} SE",
            form.name, measured.mean, measured.standard_error
        );
        assert!(off.abs() <= 4.0, "{}: {} for {truth}", form.name, measured.mean);
        assert!(measured.standard_error <= 0.01 * truth, "{}: a standard error above 1 %", form.name);
        (forms, tried) = (forms + 1, tried + measured.count);
        exact += u32::from(measured.is_exact(truth));
    }
    eprintln!("closed forms: {forms} with {tried} samples, {exact} of them without noise and held to rounding");
}

/// How many times the samples of a test are taken.
pub fn times_samples() -> u32 {
    std::env::var("PINHOLE_TEST_SAMPLES").map_or(1, |times| times.parse().expect("a whole number"))
}

/// Renders of a scene by an integrator, with seeds of their own.
fn renders_by(
    make: &dyn Fn() -> World,
    integrator: Integrator,
    samples: u32,
    seeds: std::ops::Range<u64>,
) -> Vec<Numbers> {
    let (samples, offer) = (times_samples() * samples, offer());
    let image = |seed| {
        let mut world = make();
        let camera = named(&mut world, "camera");
        let sampling = Sampling { samples, seed, sampler: Sampler::Independent, ..Sampling::default() };
        world.entity_mut(camera).insert((sampling, integrator));
        numbers(&render(&world, &offer, &Execution::default(), &()).expect("renders").film)
    };
    seeds.map(image).collect()
}

/// Renders of a scene by paths that find light so.
fn renders(make: &dyn Fn() -> World, lights: LightStrategy, samples: u32, seeds: std::ops::Range<u64>) -> Vec<Numbers> {
    let integrator = match integrator_of(&Census::of(&make())).integrator {
        Integrator::Path { max_depth, roulette, .. } => Integrator::Path { max_depth, lights, roulette },
        other => panic!("{other:?} finds lights in one way only"),
    };
    renders_by(make, integrator, samples, seeds)
}

/// Whether two sets of renders agree in every block of so many pixels a side, and as a whole.
///
/// A block must be off by some four times the resolution to be found, so there is a limit to that, and a lower one for
/// the image as a whole.
fn assert_agree(what: &str, one: &[Numbers], other: &[Numbers], side: u32) -> Agreement {
    let whole = agreement(one, other, u32::MAX).expect("one size");
    assert!(whole.agrees(), "{what}: the means of whole images differ, {whole:?}");
    assert!(whole.resolution < 0.1, "{what}: a whole image is known to {:.1} % only", 100.0 * whole.resolution);
    let found = agreement(one, other, side).expect("one size");
    let Agreement { tests, apart, min, limit, resolution } = found;
    eprintln!(
        "{what}: {apart} of {tests} blocks apart, least likely {min:.1e} (limit {limit:.1e}), resolution {:.1} %",
        100.0 * resolution
    );
    assert!(found.agrees(), "{what}");
    assert!(resolution < 0.25, "{what}: a block is known to {:.1} % only", 100.0 * resolution);
    found
}

/// All strategies to find light, and those that do not wait for BSDF sampling to hit a small light.
const ALL: &[LightStrategy] = &[LightStrategy::Bsdf, LightStrategy::Light, LightStrategy::Mis];
const NOT_BY_BSDF: &[LightStrategy] = &[LightStrategy::Light, LightStrategy::Mis];

/// Whether these ways to find light bring the same to every block of pixels of a scene, pair by pair.
fn strategies_agree(name: &str, make: &dyn Fn() -> World, strategies: &[LightStrategy], samples: u32, side: u32) {
    const SETS: u64 = 12;
    let rendered = |(number, &lights): (usize, &LightStrategy)| {
        let more = if lights == LightStrategy::Bsdf { 4 } else { 1 };
        let first = SETS * number as u64;
        (lights, renders(make, lights, more * samples, first..first + SETS))
    };
    let sets: Vec<_> = strategies.iter().enumerate().map(rendered).collect();
    for (number, (lights, one)) in sets.iter().enumerate() {
        for (others, other) in &sets[number + 1..] {
            assert_agree(&format!("{name}, {lights:?} and {others:?}"), one, other, side);
        }
    }
}

#[test]
fn light_strategies_agree_on_the_public_scenes() {
    for (name, samples) in [
        ("cornell", 8),
        ("cornell-glass", 8),
        ("veach-mis", 24),
        ("spheres", 4),
        ("spheres-lens", 4),
        ("spheres-sky", 4),
    ] {
        let make = || {
            let mut world = public(name, LightStrategy::Mis);
            let camera = named(&mut world, "camera");
            let Resolution { width, height } = *world.get::<Resolution>(camera).expect("a size");
            world.entity_mut(camera).insert(Resolution { width: width / 8, height: height / 8 });
            world
        };
        strategies_agree(name, &make, ALL, samples, 8);
    }
}

#[test]
fn light_strategies_agree_on_the_chapters_scenes() {
    for (name, samples) in [("25_path_tracing", 8), ("26_choosing_samples", 24)] {
        strategies_agree(name, &|| chapter_at(name, 48, 32), ALL, samples, 8);
    }
    // The others by paths too, whatever integrator they name; caustics come from the lights where the scene has them so.
    const PATH: Integrator = Integrator::Path { max_depth: 6, lights: LightStrategy::Mis, roulette: 3 };
    for (name, strategies) in [
        ("cover", NOT_BY_BSDF),
        ("19_mirrors", ALL),
        ("20_glass", ALL),
        ("21_soft_shadows", NOT_BY_BSDF),
        ("22_ambient_occlusion", ALL),
        ("23_depth_of_field", ALL),
        ("24_motion_blur", ALL),
        ("27_caustics", NOT_BY_BSDF),
    ] {
        let make = || {
            let mut world = chapter_at(name, 24, 16);
            let camera = named(&mut world, "camera");
            world.entity_mut(camera).insert(PATH);
            // That chapter has no light of its own, and two black pictures agree about nothing.
            if name == "22_ambient_occlusion" {
                world.spawn(Background { colour: Rgb::grey(1.0) });
            }
            world
        };
        // Its light is small and bright, so that its few pixels are the noisiest.
        let samples = if name == "21_soft_shadows" { 32 } else { 8 };
        strategies_agree(name, &make, strategies, samples, 4);
    }
}

fn chapter_at(name: &str, width: u32, height: u32) -> World {
    let chapter = chapters::all().into_iter().find(|chapter| chapter.name == name).expect("a chapter");
    chapter.world(&Overrides { resolution: Some(Resolution { width, height }), ..Overrides::default() })
}

/// Direct light by the integrators that compute nothing else is what paths of two segments carry, where no sky lights things.
#[test]
fn integrators_of_direct_light_agree_with_short_paths() {
    const SETS: u64 = 12;
    for name in ["21_soft_shadows", "23_depth_of_field", "24_motion_blur"] {
        let make = || {
            let mut world = chapter_at(name, 24, 16);
            let mut skies = world.query_filtered::<Entity, Or<(With<Background>, With<Gradient>)>>();
            let skies: Vec<Entity> = skies.iter(&world).collect();
            skies.into_iter().for_each(|sky| _ = world.despawn(sky));
            world
        };
        let own = integrator_of(&Census::of(&make())).integrator;
        assert!(matches!(own, Integrator::RayCasting | Integrator::Distribution { .. }), "{name}: {own:?}");
        let own = renders_by(&make, own, 20, 0..SETS);
        for (number, &lights) in NOT_BY_BSDF.iter().enumerate() {
            let first = SETS * (number as u64 + 1);
            let short = Integrator::Path { max_depth: 2, lights, roulette: 0 };
            let short = renders_by(&make, short, 20, first..first + SETS);
            assert_agree(&format!("{name}, by itself and by short paths, {lights:?}"), &own, &short, 4);
        }
    }
}
