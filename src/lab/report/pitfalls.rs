//! Naive measurements of a scene beside the report's own: no times, so the same numbers everywhere.

use super::curve::{Curve, Level};
use super::ensemble::{Ensemble, Reference};
use super::interval::{Interval, LEVEL};
use super::runner::{Variant, image_of};
use super::table::short;
use crate::measure::image_error::Numbers;
use crate::naive::error::{mean_absolute_percentage, mean_square, slope_of_ends};
use pinhole::scene::{Sampler, Sampling};
use pinhole::{Error, Result};
use serde::Serialize;
use std::fmt;

/// Sample counts of the runs.
const LADDER: [u32; 4] = [1, 4, 16, 64];
/// Seeds of each.
const SEEDS: u64 = 8;
/// Batches of the reference, and the samples of each.
const BATCHES: u64 = 8;
const BATCH_SAMPLES: u32 = 128;
/// How bright the spark is that is put into one pixel.
const SPARK: f64 = 100.0;

/// A naive measurement beside what is right.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Pitfall {
    /// What is measured, and how.
    pub measurement: &'static str,
    /// What that gives.
    pub gives: Given,
    /// What is right.
    pub right: Given,
}

/// What a measurement gives.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Given {
    /// A number.
    Value(f64),
    /// A slope.
    Slope(f64),
    /// The least and the most of several numbers.
    LeastToMost([f64; 2]),
    /// How many times a mean has grown.
    Times(f64),
    /// How many times an MSE has grown.
    MseTimes(f64),
    /// A number with its interval.
    Interval(Interval),
    /// No value, and why.
    Refused(String),
}

impl fmt::Display for Given {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Self::Value(value) => short(*value),
            Self::Slope(slope) => format!("{slope:.3}"),
            Self::LeastToMost([min, max]) => format!("{} to {}", short(*min), short(*max)),
            Self::Times(times) => format!("{times:.2} times"),
            Self::MseTimes(times) => format!("MSE: {times:.0} times"),
            Self::Interval(Interval { low, value, high }) => {
                format!("{} ({} to {})", short(*value), short(*low), short(*high))
            }
            Self::Refused(why) => why.clone(),
        };
        f.pad(&text)
    }
}

/// The measurements as a table.
pub fn pitfalls_table(pitfalls: &[Pitfall]) -> String {
    let mut text = format!("{:<52} {:<22} right\n", "naive measurement", "gives");
    for Pitfall { measurement, gives, right } in pitfalls {
        text += &format!("{measurement:<52} {gives:<22} {right}\n");
    }
    text
}

/// Naive measurements, each beside what is right; of independent samples, whatever the scene has.
///
/// Errors: what a render would be refused for.
pub fn pitfalls(variant: &Variant<'_>) -> Result<Vec<Pitfall>> {
    let render = |samples: u32, seed: u64| -> Result<Numbers> {
        image_of(variant, Sampling { samples, seed, sampler: Sampler::Independent, ..variant.sampling })
    };
    let batches = (0..BATCHES).map(|batch| render(BATCH_SAMPLES, 1_000_000 + batch)).collect::<Result<Vec<_>>>()?;
    let reference = Reference::of(&batches).ok_or_else(|| Error::Usage("the reference has no batches".into()))?;
    let mut levels = Vec::new();
    let mut images = Vec::new();
    for (level, &samples) in LADDER.iter().enumerate() {
        let runs = (1..=SEEDS).map(|run| render(samples, 100 * level as u64 + run)).collect::<Result<Vec<_>>>()?;
        let ensemble = Ensemble::of(&runs, &reference);
        levels.push(Level { samples: samples.into(), ensemble, seconds: vec![1.0; SEEDS as usize] });
        images.push(runs);
    }
    let seeds = SEEDS as usize;
    let curve =
        Curve { levels, seeds, batches: BATCHES as usize, reference_samples: BATCHES * u64::from(BATCH_SAMPLES) };
    let right = |level: usize| curve.levels[level].told_mse(LEVEL).map(|mse| mse.interval(LEVEL));
    let mut rows = Vec::new();
    let mut row = |measurement, gives, right| rows.push(Pitfall { measurement, gives, right });
    let told = |told: std::result::Result<Interval, super::refused::Refused>| match told {
        Ok(interval) => Given::Interval(interval),
        Err(refused) => Given::Refused(refused.to_string()),
    };
    // A reference of the run's own seed holds the run's own samples.
    let own = render(4 * LADDER[2], 201)?;
    let shared = mean_square(&own.pixels, &images[2][0].pixels);
    row("MSE of 16 samples, reference of 64 of the same seed", Given::Value(shared), told(right(2)));
    let same = render(LADDER[3], 301)?;
    let nothing = mean_square(&same.pixels, &images[3][0].pixels);
    row("MSE of 64 samples, reference of the same 64", Given::Value(nothing), told(right(3)));
    // One image, and no word of how far another seed's may be off.
    let each: Vec<f64> = images[0].iter().map(|image| mean_square(&reference.mean.pixels, &image.pixels)).collect();
    let [min, max] = [each.iter().copied().fold(f64::INFINITY, f64::min), each.iter().copied().fold(0.0, f64::max)];
    row("MSE of 1 sample, one image (of 8: least to most)", Given::LeastToMost([min, max]), told(right(0)));
    // A reference no longer than the longest run, its noise left in.
    let other = render(LADDER[3], 1_000_100)?;
    let points: Vec<[f64; 2]> = (LADDER.iter().zip(&images))
        .map(|(&samples, runs)| [f64::from(samples), mean_square(&other.pixels, &runs[0].pixels)])
        .collect();
    let slope = curve.slope(LEVEL).map(|slope| slope.interval(LEVEL));
    row("slope of one seed, reference of 64 samples left in", Given::Slope(slope_of_ends(&points)), told(slope));
    // One spark in one pixel.
    let before = &images[2][0];
    let mut spoilt = before.clone();
    let middle = spoilt.pixels.len() / 2;
    if let Some(pixel) = spoilt.pixels.get_mut(middle) {
        *pixel = [SPARK; 3];
    }
    let times = |measure: fn(&[[f64; 3]], &[[f64; 3]]) -> f64| {
        measure(&reference.mean.pixels, &spoilt.pixels) / measure(&reference.mean.pixels, &before.pixels)
    };
    let [percent, square] = [times(mean_absolute_percentage), times(mean_square)];
    row("one pixel of 100: the mean of |x − r| / r grows", Given::Times(percent), Given::MseTimes(square));
    Ok(rows)
}
