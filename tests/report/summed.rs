//! What a report says of runs whose errors and times are known.

use super::synthetic::{Noise, Renderer};
use bevy_ecs::prelude::*;
use pinhole::scene::Sampling;
use pinhole_lab::measure::image_error::Numbers;
use pinhole_lab::report::distribution::student_cdf;
use pinhole_lab::report::interval::{LEVEL, bca};
use pinhole_lab::report::kept::{LARGEST, keep, place};
use pinhole_lab::report::ladder::Ladder;
use pinhole_lab::report::provenance::Provenance;
use pinhole_lab::report::run::{Run, Times};
use pinhole_lab::report::runner::{Runs, Variant};
use pinhole_lab::report::sum_up::{measure, sum_up};
use pinhole_lab::report::summary::Report;
use std::cell::RefCell;
use std::f64::consts::PI;

/// The errors of the first variant's runs at one sample; the second variant's are twice as large.
const ERRORS: [f64; 4] = [0.1, -0.2, 0.3, -0.05];

/// A report of runs on two threads, each of which takes a second and so much CPU time for every sample.
fn report_of(cpu: f64) -> Report {
    let ladder = Ladder { samples: vec![1, 4], seeds: 4, batches: 4, batch_samples: 64 };
    let run = |value: f64, samples: u32| {
        let seconds = f64::from(samples);
        Run {
            image: Numbers { size: [1, 1], pixels: vec![[value; 3]], white: None },
            times: Times { wall: seconds, cpu: cpu * seconds, build: 0.0 },
            rejected: 0,
        }
    };
    let level = |samples: u32, scale: f64| {
        ERRORS.map(|error| run(1.0 + scale * error / f64::from(samples).sqrt(), samples)).to_vec()
    };
    let levels = [1.0, 2.0].map(|scale| ladder.samples.iter().map(|&samples| level(samples, scale)).collect());
    let runs = Runs {
        references: vec![vec![run(1.0, ladder.batch_samples); 4], Vec::new()],
        levels: levels.to_vec(),
        stages: vec![Vec::new(); 2],
        timers: None,
    };
    let variants = ["first", "second"].map(|name| Variant {
        name: name.into(),
        sampling: Sampling::default(),
        stages: Vec::new(),
        scene: Box::new(World::new),
        reference: 0,
    });
    let measured = measure(&variants, &ladder, &runs).expect("measured");
    let empty = Report {
        name: "known".into(),
        title: String::new(),
        against: Vec::new(),
        scenes: Vec::new(),
        size: [1, 1],
        ladder,
        threads: 2,
        variants: Vec::new(),
        comparisons: Vec::new(),
        family_level: 0.0,
        timers: None,
        flags: Vec::new(),
        provenance: Provenance::default(),
    };
    sum_up(empty, &variants, &runs, &measured)
}

#[test]
fn a_variant_of_twice_the_error_is_compared_with_the_first() {
    let comparisons = report_of(2.0).comparisons;
    // At both sample counts, and at five times between.
    assert_eq!(comparisons.len(), 2 + 5);
    for own in comparisons {
        let mse = own.mse.value().expect("a ratio").value;
        assert!(own.variant == "second" && (mse - 4.0).abs() < 1e-9, "{mse} times the MSE at {:?}", own.at);
    }
}

#[test]
fn only_a_run_that_leaves_its_threads_idle_is_flagged() {
    let waiting = |cpu: f64| report_of(cpu).flags.into_iter().find(|flag| flag.starts_with("CPU time differs"));
    assert_eq!(waiting(2.0), None);
    let idle = waiting(1.0).expect("a flag");
    assert!(idle.contains("in 4 of 4 rows") && idle.ends_with("by 50 %"), "{idle}");
}

/// An interval by drawing anew asks for as many runs as there are, and for its acceleration leaves out one at a time.
#[test]
fn a_bootstrap_leaves_out_each_run_once() {
    const RUNS: usize = 5;
    let left_out = RefCell::new(Vec::new());
    let statistic = |weights: &[f64]| {
        let sum: f64 = weights.iter().sum();
        if sum != RUNS as f64 {
            left_out.borrow_mut().push(weights.to_vec());
        }
        Some(weights[0] / sum)
    };
    bca(RUNS, LEVEL, statistic).expect("an interval");
    let all_but = |out: usize| (0..RUNS).map(|run| if run == out { 0.0 } else { 1.0 }).collect::<Vec<f64>>();
    assert_eq!(left_out.into_inner(), [0, 1, 2, 3, 4].map(all_but));
}

/// Where every run takes the same time, efficiencies are exactly as uncertain as MSEs, however far apart the times are.
#[test]
fn times_without_noise_add_no_uncertainty() {
    let renderer = Renderer { noise: Noise::Gaussian, deviation: 0.3, bias: 0.0, seconds: 1.0 };
    let reference = renderer.reference(1, 5);
    let [one, other] = [(1, 1e-50), (2, 1e50)].map(|(seed, seconds)| {
        let mut curve = renderer.curve(&[1], 4, (&reference, 1), seed);
        curve.levels[0].seconds = vec![seconds; 4];
        curve
    });
    let mse = one.log_mse_ratio(&other, 0).expect("a ratio");
    let efficiency = one.log_efficiency_ratio(&other, 0).expect("a ratio");
    assert!((efficiency.value + mse.value - 1e100_f64.ln()).abs() < 1e-9, "{efficiency:?}, {mse:?}");
    let off = [efficiency.variance / mse.variance - 1.0, efficiency.freedom / mse.freedom - 1.0];
    assert!(off.iter().all(|off| off.abs() < 1e-9), "{efficiency:?}, {mse:?}");
}

/// Near the middle, where the continued fraction of the incomplete beta function alone would converge too slowly.
#[test]
fn student_s_t_has_its_closed_forms_near_the_middle_too() {
    for t in [1e-2, -1e-3, 1e-5_f64] {
        let [cauchy, second] = [0.5 + t.atan() / PI, 0.5 + t / (2.0 * (2.0 + t * t).sqrt())];
        let off = [student_cdf(t, 1.0) - cauchy, student_cdf(t, 2.0) - second];
        assert!(off.iter().all(|off| off.abs() < 1e-12), "t {t}: {off:?}");
    }
}

#[test]
fn the_file_of_a_kept_report_has_at_most_20_kib() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    // Joined to the repository's root, an absolute path stays as it is.
    let name = folder.path().display().to_string();
    let mut report = Report { name, ..report_of(2.0) };
    let bytes = |report: &Report| {
        keep(report).expect("kept");
        std::fs::metadata(place(&report.name)).expect("a file").len() as usize
    };
    report.title = "x".repeat(LARGEST - bytes(&report));
    assert_eq!(bytes(&report), LARGEST);
    report.title.push('x');
    assert!(keep(&report).is_err());
}
