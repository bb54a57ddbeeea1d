//! Samplers and filters in full: what means vary by, over samples and time; what a number and a place cost.
//!
//! `cargo bench --bench samplers` prints for each function of known integral and variance each sampler's variance at
//! 1 to 4,096 samples, its bias in standard errors, and its slope with its 95 % interval; then the nanoseconds of a point
//! and of a filter's offset.
//! `-- --trials 200` takes fewer means.
#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

#[allow(dead_code, reason = "pairs and their interval are for other benchmarks")]
mod interval;

use interval::{cpu, median};
use pinhole::extract::cells_of;
use pinhole::sample::{
    Draw, INTEGRANDS, Independent, MeanError, PixelKey, Purpose, Sobol, Stratified, box_offset, mean_error, slope,
    table_offset, tent_offset, unit,
};
use pinhole::scene::{Filter, Sampler};
use std::hint::black_box;

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let after = |flag: &str| words.iter().position(|word| word == flag).and_then(|at| words.get(at + 1));
    let trials = after("--trials").and_then(|trials| trials.parse().ok()).unwrap_or(4000);
    for integrand in INTEGRANDS {
        println!("{}: mean {:.6}, variance {:.6}", integrand.name, integrand.mean, integrand.variance);
        for (word, sampler) in Sampler::ALL {
            let level = |k: u32| mean_error(sampler, Purpose::Pixel, integrand, 1 << k, trials, 1);
            let levels: Vec<MeanError> = (0..=12).map(level).collect();
            for MeanError { samples, bias, variance, variance_error, .. } in &levels {
                let of_dice = variance * f64::from(*samples) / integrand.variance;
                let off = bias / (variance / f64::from(trials)).sqrt();
                println!(
                    "  {word:<12}{samples:>6} samples  variance {variance:.4e} ± {variance_error:.1e}, \
                     {of_dice:.2e} of that by dice, biased by {off:+.2} standard errors"
                );
            }
            // From 4 on, at powers of 4: the squares of the stratified sampler.
            let fitted: Vec<MeanError> = levels.iter().copied().skip(2).step_by(2).collect();
            let (slope, half) = slope(&fitted);
            println!("  {word:<12}slope from 4 to 4096 samples {slope:.3} ± {half:.3} ({trials} means a level)");
        }
    }
    points();
    offsets();
}

const PIXELS: u32 = 1 << 20;

/// Nanoseconds a call, the median of fifteen runs.
fn nanoseconds(run: impl Fn() -> f64) -> f64 {
    let once = || cpu(&|| black_box(run())).as_nanos() as f64 / f64::from(PIXELS);
    median(&mut (0..15).map(|_| once()).collect::<Vec<f64>>())
}

fn sum_over_pixels<D: Draw>(draw: D) -> f64 {
    (0..PIXELS)
        .map(|pixel| {
            let [x, y] = draw.two(PixelKey::new(1, [pixel & 1023, pixel >> 10])).map(unit);
            x + y
        })
        .sum()
}

fn points() {
    let independent = nanoseconds(|| sum_over_pixels(Independent::new(5, 0, Purpose::Pixel)));
    let stratified = nanoseconds(|| sum_over_pixels(Stratified::new(5, 16, 0, Purpose::Pixel)));
    let non_uniform = nanoseconds(|| sum_over_pixels(Stratified::new(5, 17, 0, Purpose::Pixel)));
    let sobol = nanoseconds(|| sum_over_pixels(Sobol::new(5, 0, Purpose::Pixel)));
    println!(
        "a point of 2 numbers: independent {independent:.2} ns, stratified {stratified:.2} ns (17 samples: \
         {non_uniform:.2} ns), sobol {sobol:.2} ns"
    );
}

fn offsets() {
    for (word, filter) in Filter::ALL {
        let cells = cells_of(filter);
        let sum = |offset: &dyn Fn(f64) -> f64| -> f64 {
            (0..PIXELS).map(|bits| offset(unit(bits.wrapping_mul(2_654_435_761)))).sum()
        };
        let taken = match filter {
            Filter::Box { radius } => nanoseconds(|| sum(&|u| box_offset(u, radius))),
            Filter::Tent { radius } => nanoseconds(|| sum(&|u| tent_offset(u, radius))),
            _ => nanoseconds(|| sum(&|u| table_offset(u, &cells).0)),
        };
        println!(
            "an offset of {word}: {taken:.2} ns, table of {} bytes",
            cells.cells.len() * 56 + cells.first.len() * 2
        );
    }
}
