//! Error against sample count and against time: slope, efficiency, and how two curves compare.

use super::ensemble::{Ensemble, FEWEST};
use super::interval::{Estimate, Interval, bca, jackknife, joined};
use super::refused::{MAX_OF_REFERENCE, Refused};

/// The squares of errors, in those of the image, that are the rounding of sums and no error: (2⁻⁴⁸)².
const ROUNDING: f64 = 1.3e-29;

/// All runs of one sample count.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Samples a pixel.
    pub samples: u64,
    /// What their images have in common with each other and with the reference.
    pub ensemble: Ensemble,
    /// CPU time of the render alone, of each run, in seconds.
    pub seconds: Vec<f64>,
}

/// Error against sample count and time of one way to render.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// From few samples to many.
    pub levels: Vec<Level>,
    /// Seeds a level.
    pub seeds: usize,
    /// Batches of the reference.
    pub batches: usize,
    /// Samples a pixel of the reference, all batches together.
    pub reference_samples: u64,
}

/// A weight for each run, and the batch of the reference that is left out.
type Drawn<'a> = (&'a [f64], Option<usize>);

impl Level {
    fn mse(&self, (weights, batch): Drawn<'_>) -> Option<f64> {
        self.ensemble.mse_without(weights, batch).filter(|mse| *mse > 0.0)
    }

    fn time(&self, weights: &[f64]) -> Option<f64> {
        let sum: f64 = weights.iter().sum();
        let time = weights.iter().zip(&self.seconds).map(|(weight, time)| weight * time).sum::<f64>() / sum;
        (time > 0.0).then_some(time)
    }

    /// ln of 1 / (MSE · T).
    fn log_efficiency(&self, drawn: Drawn<'_>) -> Option<f64> {
        Some(-libm::log(self.mse(drawn)?) - libm::log(self.time(drawn.0)?))
    }

    /// The MSE, or why it is not told: the reference cannot tell it from 0.
    pub fn told_mse(&self, level: f64) -> Result<Estimate, Refused> {
        let seeds = self.seconds.len();
        let mse = self.ensemble.mse().ok_or(Refused::TooFewSeeds { seeds })?;
        let (variance, freedom) = self.ensemble.reference_part().unwrap_or((0.0, 1.0));
        let min = 0.5 * width(Estimate { value: 0.0, variance, freedom }.interval(level));
        if mse.value < min {
            return Err(Refused::BelowReference { samples: self.samples, mse: mse.value, min });
        }
        Ok(mse)
    }
}

impl Curve {
    /// A statistic by leaving out one run at a time, then one batch of the reference at a time.
    ///
    /// What runs and batches vary together shows in both, so what leaving out one of each shows beyond is taken away.
    fn estimate(&self, statistic: impl Fn(Drawn<'_>) -> Option<f64>) -> Option<Estimate> {
        let runs = jackknife(self.seeds, |weights| statistic((weights, None)))?;
        let Some((variance, freedom)) = self.batch_part(&statistic) else { return Some(runs) };
        let (r, m) = (self.seeds as f64, self.batches as f64);
        let shared = (-self.shared(runs.value, &statistic)?, (r - 1.0) * (m - 1.0));
        let (variance, freedom) = joined(&[(runs.variance, runs.freedom), (variance, freedom), shared]);
        Some(Estimate { value: runs.value, variance, freedom })
    }

    /// The variance of a statistic that comes from the reference.
    fn batch_part(&self, statistic: &impl Fn(Drawn<'_>) -> Option<f64>) -> Option<(f64, f64)> {
        if self.batches < FEWEST {
            return None;
        }
        let all = vec![1.0; self.seeds];
        let others: Option<Vec<f64>> = (0..self.batches).map(|batch| statistic((&all, Some(batch)))).collect();
        let (others, m) = (others?, self.batches as f64);
        let mean = others.iter().sum::<f64>() / m;
        let squares: f64 = others.iter().map(|other| (other - mean) * (other - mean)).sum();
        Some((squares * (m - 1.0) / m, m - 1.0))
    }

    /// The variance of a statistic that runs and batches have only together.
    fn shared(&self, value: f64, statistic: &impl Fn(Drawn<'_>) -> Option<f64>) -> Option<f64> {
        let all = vec![1.0; self.seeds];
        let batches: Option<Vec<f64>> = (0..self.batches).map(|batch| statistic((&all, Some(batch)))).collect();
        let (batches, mut weights, mut squares) = (batches?, all, 0.0);
        for run in 0..self.seeds {
            weights[run] = 0.0;
            let without = statistic((&weights, None))?;
            for (batch, of_batch) in batches.iter().enumerate() {
                let both = statistic((&weights, Some(batch)))?;
                squares += (both - without - of_batch + value) * (both - without - of_batch + value);
            }
            weights[run] = 1.0;
        }
        let (r, m) = (self.seeds as f64, self.batches as f64);
        Some(squares * (r - 1.0) * (m - 1.0) / (r * m))
    }

    /// Whether the reference carries a slope, level by level.
    fn carried(&self, level: f64) -> Result<(), Refused> {
        let longest = self.levels.last().map_or(0, |level| level.samples);
        if self.levels.len() < 2 {
            return Err(Refused::TooFewLevels);
        }
        if self.batches < 2 && longest as f64 > MAX_OF_REFERENCE * self.reference_samples as f64 {
            return Err(Refused::ReferenceTooShort { longest, reference: self.reference_samples });
        }
        for rung in &self.levels {
            // A sum of f64 rounds by 2⁻⁵³ of itself, which is no error of a picture.
            if rung.told_mse(level)?.value <= ROUNDING * rung.ensemble.square {
                return Err(Refused::NoError { samples: rung.samples });
            }
        }
        Ok(())
    }

    /// The slope of ln MSE over ln of the sample count by least squares, by t on the runs that are left out in turn.
    ///
    /// −1 for independent samples without bias; flatter where a bias or the reference's noise is the floor.
    pub fn slope(&self, level: f64) -> Result<Estimate, Refused> {
        self.carried(level)?;
        self.estimate(|drawn| self.slope_of(drawn)).ok_or(Refused::TooFewSeeds { seeds: self.seeds })
    }

    /// The same slope, its interval by drawing seeds anew (BCa), widened by what the reference is uncertain by.
    pub fn slope_by_drawing(&self, level: f64) -> Result<Interval, Refused> {
        let short = Refused::TooFewSeeds { seeds: self.seeds };
        self.carried(level)?;
        let drawn = bca(self.seeds, level, |weights| self.slope_of((weights, None))).ok_or(short)?;
        let from_batches = self.batch_part(&|drawn: Drawn<'_>| self.slope_of(drawn));
        let (variance, freedom) = from_batches.unwrap_or((0.0, 1.0));
        let half = 0.5 * width(Estimate { value: 0.0, variance, freedom }.interval(level));
        let widened = |end: f64| libm::hypot(end - drawn.value, half);
        Ok(Interval {
            low: drawn.value - widened(drawn.low),
            value: drawn.value,
            high: drawn.value + widened(drawn.high),
        })
    }

    fn slope_of(&self, drawn: Drawn<'_>) -> Option<f64> {
        let points =
            self.levels.iter().map(|level| Some([libm::log(level.samples as f64), libm::log(level.mse(drawn)?)]));
        least_squares(&points.collect::<Option<Vec<_>>>()?)
    }

    /// The efficiency of a level, 1 / (MSE · T), as its logarithm.
    pub fn log_efficiency(&self, level: usize) -> Option<Estimate> {
        self.estimate(|drawn| self.levels.get(level)?.log_efficiency(drawn))
    }

    /// ln of how many times this curve's efficiency at a level is another's.
    ///
    /// Runs are paired by their number, as they were interleaved; so are the batches of the reference.
    pub fn log_efficiency_ratio(&self, other: &Self, level: usize) -> Option<Estimate> {
        self.estimate(|drawn| {
            Some(self.levels.get(level)?.log_efficiency(drawn)? - other.levels.get(level)?.log_efficiency(drawn)?)
        })
    }

    /// ln of how many times this curve's MSE at a level is another's.
    pub fn log_mse_ratio(&self, other: &Self, level: usize) -> Option<Estimate> {
        self.estimate(|drawn| {
            Some(libm::log(self.levels.get(level)?.mse(drawn)?) - libm::log(other.levels.get(level)?.mse(drawn)?))
        })
    }

    /// ln of how many times this curve's MSE is another's after so many seconds, each read between its own levels.
    ///
    /// Errors: one of the curves does not reach that time.
    pub fn log_mse_ratio_at(&self, other: &Self, seconds: f64) -> Result<Estimate, Refused> {
        let ratio = self.estimate(|drawn| Some(self.log_mse_at(seconds, drawn)? - other.log_mse_at(seconds, drawn)?));
        ratio.ok_or(Refused::NoCommonTime)
    }

    /// The MSE after so many seconds, on the straight line in logarithms between the levels about it.
    pub fn mse_at(&self, seconds: f64) -> Option<Estimate> {
        self.estimate(|drawn| self.log_mse_at(seconds, drawn))
    }

    fn log_mse_at(&self, seconds: f64, drawn: Drawn<'_>) -> Option<f64> {
        // The levels about the time are those of all runs, so that leaving one out moves no reading to another line.
        let all = vec![1.0; self.seeds];
        let times: Vec<f64> = self.levels.iter().map(|level| level.time(&all)).collect::<Option<_>>()?;
        let upper = times.iter().position(|time| *time >= seconds).filter(|at| *at > 0 || times[0] == seconds)?.max(1);
        let point = |at: usize| {
            let level = self.levels.get(at)?;
            Some([libm::log(level.time(drawn.0)?), libm::log(level.mse(drawn)?)])
        };
        let ([x0, y0], [x1, y1]) = (point(upper - 1)?, point(upper)?);
        (x1 != x0).then(|| y0 + (y1 - y0) * (libm::log(seconds) - x0) / (x1 - x0))
    }
}

fn width(interval: Interval) -> f64 {
    interval.high - interval.low
}

// ANCHOR: least_squares
/// The slope of the straight line through points by least squares; none where all have one x.
fn least_squares(points: &[[f64; 2]]) -> Option<f64> {
    let n = points.len() as f64;
    let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / n;
    let (x, y) = (mean(0), mean(1));
    let products: f64 = points.iter().map(|point| (point[0] - x) * (point[1] - y)).sum();
    let squares: f64 = points.iter().map(|point| (point[0] - x) * (point[0] - x)).sum();
    (squares > 0.0).then(|| products / squares)
}
// ANCHOR_END: least_squares

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_gives_its_slope() {
        let slope = least_squares(&[[0.0, 3.0], [1.0, 1.0], [2.0, -1.0], [5.0, -7.0]]);
        assert!((slope.expect("a line") + 2.0).abs() < 1e-15);
        assert_eq!(least_squares(&[[1.0, 3.0], [1.0, 1.0]]), None);
    }
}
