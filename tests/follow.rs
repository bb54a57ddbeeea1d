//! Light that is followed, held against what is known of it.

mod scenes;

use pinhole::measure::closed_form::closed_forms;
use pinhole::measure::image_error::Numbers;
use pinhole::render::{Execution, render};
use pinhole::report::agreement::{Agreement, agreement};
use pinhole::report::run::numbers;
use pinhole::scene::{LightSampling, Resolution, Sampler, Sampling};
use scenes::public::public;
use scenes::{named, offer};

#[test]
fn closed_forms_hold() {
    let (mut forms, mut tried) = (0, 0);
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
    }
    eprintln!("closed forms: {forms} with {tried} samples");
}

/// Renders of a scene with seeds of its own, on a lattice of fewer pixels.
fn renders(name: &str, lights: LightSampling, samples: u32, seeds: std::ops::Range<u64>) -> Vec<Numbers> {
    let mut world = public(name, lights);
    let camera = named(&mut world, "camera");
    let size = *world.get::<Resolution>(camera).expect("a size");
    let smaller = Resolution { width: size.width / 8, height: size.height / 8 };
    let image = |seed| {
        let mut world = public(name, lights);
        let camera = named(&mut world, "camera");
        let sampling = Sampling { samples, seed, sampler: Sampler::Independent, ..Sampling::default() };
        world.entity_mut(camera).insert((smaller, sampling));
        numbers(&render(&world, &offer(), &Execution::default(), &()).expect("renders").film)
    };
    seeds.map(image).collect()
}

#[test]
fn ways_to_find_light_agree_on_the_public_scenes() {
    use LightSampling::{Aimed, ByChance, Weighed};
    const SETS: u64 = 12;
    for (name, samples) in [("cornell", 16), ("cornell-glass", 16), ("veach-mis", 24)] {
        let chance = renders(name, ByChance, 4 * samples, 0..SETS);
        let aimed = renders(name, Aimed, samples, SETS..2 * SETS);
        let weighed = renders(name, Weighed, samples, 2 * SETS..3 * SETS);
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
}
