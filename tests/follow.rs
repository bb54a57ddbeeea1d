//! Light that is followed, held against what is known of it.

#[path = "follow/broken.rs"]
mod broken;
#[path = "follow/caustics.rs"]
mod caustics;
#[path = "../chapters/mod.rs"]
mod chapters;
#[path = "follow/numerics.rs"]
mod numerics;
#[path = "follow/preflight.rs"]
mod preflight;
mod scenes;

use bevy_ecs::prelude::*;
use pinhole::Asked;
use pinhole::extract::integrator_of;
use pinhole::measure::closed_form::closed_forms;
use pinhole::measure::image_error::Numbers;
use pinhole::plan::Stage;
use pinhole::render::{Execution, render};
use pinhole::report::agreement::{Agreement, agreement};
use pinhole::report::run::numbers;
use pinhole::scene::{Integrator, LightSampling, Resolution, Sampler, Sampling};
use scenes::public::public;
use scenes::{named, offer};

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
    eprintln!("closed forms: {forms} with {tried} samples, {exact} of them without chance and held to rounding");
}

/// Renders of a scene with seeds of its own.
fn renders(make: &dyn Fn() -> World, lights: LightSampling, samples: u32, seeds: std::ops::Range<u64>) -> Vec<Numbers> {
    let image = |seed| {
        let mut world = make();
        let camera = named(&mut world, "camera");
        let sampling = Sampling { samples, seed, sampler: Sampler::Independent, ..Sampling::default() };
        let integrator = match integrator_of(&world).integrator {
            Integrator::Path { legs, roulette, .. } => Integrator::Path { legs, lights, roulette },
            other => panic!("{other:?} finds lights in one way only"),
        };
        world.entity_mut(camera).insert((sampling, integrator));
        numbers(&render(&world, &offer(), &Execution::default(), &()).expect("renders").film)
    };
    seeds.map(image).collect()
}

/// Whether light by chance, aimed at, and both weighed bring the same to every block of pixels of a scene.
fn ways_agree(name: &str, make: &dyn Fn() -> World, samples: u32) {
    use LightSampling::{Aimed, ByChance, Weighed};
    const SETS: u64 = 12;
    let chance = renders(make, ByChance, 4 * samples, 0..SETS);
    let aimed = renders(make, Aimed, samples, SETS..2 * SETS);
    let weighed = renders(make, Weighed, samples, 2 * SETS..3 * SETS);
    let pairs = [
        ("chance, aimed", &chance, &aimed),
        ("chance, weighed", &chance, &weighed),
        ("aimed, weighed", &aimed, &weighed),
    ];
    for (pair, one, other) in pairs {
        let found = agreement(one, other, 8).expect("one size");
        let Agreement { tests, apart, least, limit, resolution } = found;
        eprintln!(
            "{name}, {pair}: {apart} of {tests} blocks apart, least likely {least:.1e} (limit {limit:.1e}), resolution {:.1} %",
            100.0 * resolution
        );
        assert!(found.agrees(), "{name}: {pair}");
    }
}

#[test]
fn ways_to_find_light_agree_on_the_public_scenes() {
    for (name, samples) in [("cornell", 16), ("cornell-glass", 16), ("veach-mis", 24)] {
        let make = || {
            let mut world = public(name, LightSampling::Weighed);
            let camera = named(&mut world, "camera");
            let Resolution { width, height } = *world.get::<Resolution>(camera).expect("a size");
            world.entity_mut(camera).insert(Resolution { width: width / 8, height: height / 8 });
            world
        };
        ways_agree(name, &make, samples);
    }
}

#[test]
fn ways_to_find_light_agree_on_the_chapters_scenes() {
    for (name, samples) in [("25_path_tracing", 16), ("26_choosing_samples", 24)] {
        let chapter = chapters::all().into_iter().find(|chapter| chapter.name == name).expect("a chapter");
        let asked = Asked { resolution: Some(Resolution { width: 48, height: 32 }), ..Asked::default() };
        ways_agree(name, &|| chapter.world(&asked), samples);
    }
}
