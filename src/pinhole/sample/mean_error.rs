//! The error of Monte Carlo estimates by sampler, on functions whose integral and variance are known.
//!
//! Each pixel of a line is one trial with random numbers of its own.

use super::{Draw, PixelKey, Purpose, SampleIndex, unit, with_sampler};
use crate::each::Each;
use crate::scene::Sampler;
use std::f64::consts::PI;

/// A function on the unit square, or on the unit interval if it ignores the second coordinate.
#[derive(Clone, Copy)]
pub struct Integrand {
    /// Its name in reports.
    pub name: &'static str,
    /// Its value.
    pub value: fn([f64; 2]) -> f64,
    /// Its integral.
    pub mean: f64,
    /// The variance of its value at a uniform random point.
    pub variance: f64,
}

/// Functions of known integral and variance, from the smoothest to the roughest.
pub const INTEGRANDS: [Integrand; 4] = [
    Integrand {
        name: "a wave along one axis",
        value: |[x, _]| PI / 2.0 * libm::cos(PI / 2.0 * x),
        mean: 1.0,
        variance: PI * PI / 8.0 - 1.0,
    },
    Integrand {
        name: "a wave along both axes",
        value: |[x, y]| PI * PI / 4.0 * libm::cos(PI / 2.0 * x) * libm::cos(PI / 2.0 * y),
        mean: 1.0,
        variance: PI * PI * PI * PI / 64.0 - 1.0,
    },
    Integrand {
        name: "a quarter of a disk",
        value: |[x, y]| if x * x + y * y < 1.0 { 1.0 } else { 0.0 },
        mean: PI / 4.0,
        variance: PI / 4.0 * (1.0 - PI / 4.0),
    },
    Integrand {
        name: "an oblique edge",
        value: |[x, y]| if x < 0.2 + 0.6 * y { 1.0 } else { 0.0 },
        mean: 0.5,
        variance: 0.25,
    },
];

/// The statistics of the error of estimates, over trials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanError {
    /// Samples per estimate.
    pub samples: u32,
    /// The number of estimates.
    pub trials: u32,
    /// Their mean minus the integral.
    pub bias: f64,
    /// Their mean squared error.
    pub variance: f64,
    /// The standard error of `variance`.
    pub variance_error: f64,
}

/// Estimates an integral in many trials, at points of a purpose that draws two numbers.
pub fn mean_error(
    sampler: Sampler,
    purpose: Purpose,
    integrand: Integrand,
    samples: u32,
    trials: u32,
    seed: u64,
) -> MeanError {
    let sample = |number| SampleIndex { number, samples, depth: 0 };
    let errors: Vec<f64> =
        with_sampler!(sampler, D => errors(|n| D::of(sample(n), purpose), integrand, samples, trials, seed));
    let n = f64::from(trials);
    let bias = errors.iter().sum::<f64>() / n;
    let squares = || errors.iter().map(|error| error * error);
    let variance = squares().sum::<f64>() / n;
    let spread = squares().map(|square| (square - variance) * (square - variance)).sum::<f64>() / (n - 1.0);
    MeanError { samples, trials, bias, variance, variance_error: (spread / n).sqrt() }
}

fn errors<D: Draw>(draw: impl Fn(u32) -> D, f: Integrand, samples: u32, trials: u32, seed: u64) -> Vec<f64> {
    let draws: Vec<D> = (0..samples).map(draw).collect();
    let mean = |trial: u32| {
        let pixel = PixelKey::new(seed, [trial, 0]);
        let sum: f64 = draws.iter().map(|draw| (f.value)(draw.two(pixel).each(unit))).sum();
        sum / f64::from(samples)
    };
    (0..trials).map(|trial| mean(trial) - f.mean).collect()
}

/// The slope of log variance over log samples, by least squares, and the half-width of its 95 % confidence interval.
///
/// The interval is propagated from the standard error of each level.
pub fn slope(levels: &[MeanError]) -> (f64, f64) {
    let n = levels.len() as f64;
    let xs: Vec<f64> = levels.iter().map(|level| libm::log(f64::from(level.samples))).collect();
    let mean = xs.iter().sum::<f64>() / n;
    let spread: f64 = xs.iter().map(|x| (x - mean) * (x - mean)).sum();
    let weights = || xs.iter().map(|x| (x - mean) / spread);
    let slope = weights().zip(levels).map(|(weight, level)| weight * libm::log(level.variance)).sum();
    let square = |relative: f64| relative * relative;
    let errors = weights().zip(levels).map(|(weight, level)| square(weight * level.variance_error / level.variance));
    (slope, 1.96 * errors.sum::<f64>().sqrt())
}
