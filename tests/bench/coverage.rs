//! How often the intervals of `report` hold the truth, on renderers whose variance and bias are known.
//!
//! `cargo bench --bench coverage` repeats each 4,000 times; `-- --repetitions 200` takes fewer.
//! Those marked `*` are outside 93 to 97 %.
//! Then what the timers of the stages cost: CPU time with them over that without.

#![allow(clippy::disallowed_methods, reason = "what is measured here may come from the platform's functions")]
#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

#[path = "../report/coverage.rs"]
mod coverage;
#[path = "../report/synthetic.rs"]
mod synthetic;

use pinhole::Overrides;
use pinhole::render::Execution;
use pinhole::scene::{Resolution, Sampling};
use pinhole_lab::report::interval::{LEVEL, mean_of};
use pinhole_lab::report::runner::{Variant, timers};
use synthetic::Noise;

/// The half-width below which sixteen seeds tell nothing of an efficiency (NUMERICS.md, section 1).
const RESOLUTION: f64 = 0.077;
/// How often the timers' cost is measured.
const TIMINGS: usize = 12;

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let after = |flag: &str| words.iter().position(|word| word == flag).and_then(|at| words.get(at + 1));
    let repetitions = after("--repetitions").and_then(|count| count.parse().ok()).unwrap_or(4000);
    let noises = [Noise::Gaussian, Noise::Uniform, Noise::Lognormal(0.5), Noise::Lognormal(1.0), Noise::Lognormal(2.5)];
    for noise in noises {
        for bias in [0.0, 0.1] {
            println!("{noise:?}, bias field up to {bias}");
            for row in coverage::coverage(noise, bias, repetitions) {
                let percent = 100.0 * row.held as f64 / row.of.max(1) as f64;
                let mark = if (93.0..=97.0).contains(&percent) { ' ' } else { '*' };
                println!("  {:<40} {percent:5.1} %{mark}  of {}, {} refused", row.what, row.of, row.refused);
            }
        }
    }
    timers_on_and_off();
}

fn timers_on_and_off() {
    let chapter = chapters::all().into_iter().find(|chapter| chapter.name == "18_error_and_time").expect("chapter 18");
    let asked = Overrides { resolution: Some(Resolution { width: 192, height: 108 }), ..Overrides::default() };
    let scene = Box::new(|| chapter.world(&asked));
    let (sampling, stages) = (Sampling::default(), chapter.stages());
    let variant = Variant { name: "18".into(), sampling, stages, scene, reference: 0 };
    let execution = Execution { threads: Some(1), ..Execution::default() };
    // What a report measures by nine pairs is too coarse to tell a few percent; so it is measured often.
    let ratio = || timers(&variant, &execution, &()).expect("a render").expect("nine pairs").value.ln();
    let logs: Vec<f64> = (0..TIMINGS).map(|_| ratio()).collect();
    let ratio = mean_of(&logs).expect("many").interval(LEVEL).of_logarithm();
    let within = ratio.low >= 1.0 - RESOLUTION && ratio.high <= 1.0 + RESOLUTION;
    println!(
        "timers on over off: {:.4} ({:.4} to {:.4}) by {TIMINGS} times nine pairs; {} the resolution of ±{:.1} %",
        ratio.value,
        ratio.low,
        ratio.high,
        if within { "within" } else { "not shown to be within" },
        100.0 * RESOLUTION
    );
}
