//! How often an interval at 95 % holds the truth.

use super::synthetic::{Noise, Renderer};
use pinhole_lab::report::interval::{Interval, LEVEL};

/// What is estimated, how its interval is made, and how often it held the truth.
#[derive(Clone, Debug)]
pub struct Coverage {
    pub what: &'static str,
    pub held: usize,
    pub of: usize,
    /// Repetitions in which the interval was refused.
    pub refused: usize,
}

/// The ladder of the repetitions.
pub const LADDER: [u64; 4] = [1, 2, 4, 8];
/// Seeds a level.
pub const SEEDS: usize = 16;
/// Samples of each batch of the reference.
pub const BATCH: u64 = 8;

/// Repeats whole reports on renderers of known error.
pub fn coverage(noise: Noise, bias: f64, repetitions: usize) -> Vec<Coverage> {
    let one = Renderer { noise, deviation: 0.3, bias, seconds: 1e-3 };
    let other = Renderer { deviation: 0.2, seconds: 2e-3, ..one };
    let mut found: Vec<Coverage> = Vec::new();
    for repetition in 0..repetitions as u64 {
        let reference = one.reference(BATCH, repetition);
        let against = (&reference, BATCH);
        let [curve, rival] = [(one, 2 * repetition), (other, 2 * repetition + 1)]
            .map(|(renderer, seed)| renderer.curve(&LADDER, SEEDS, against, seed + 1));
        let last = LADDER.len() - 1;
        let top = &curve.levels[last].ensemble;
        let ratio = |samples| (other.mse(samples) * other.seconds / one.mse(samples) / one.seconds).ln();
        let slope = one.slope(&LADDER);
        let t = |estimate: Option<pinhole_lab::report::interval::Estimate>| estimate.map(|it| it.interval(LEVEL));
        let tried: [(&'static str, Option<Interval>, f64); 9] = [
            ("MSE, 1 sample, t", t(curve.levels[0].ensemble.mse()), one.mse(1)),
            ("MSE, 8 samples, t", t(top.mse()), one.mse(8)),
            ("MSE, 8 samples, t of logs", top.mse().and_then(|it| it.log_interval(LEVEL)), one.mse(8)),
            ("variance, 8 samples, t", t(top.variance()), one.variance(8)),
            ("bias², 8 samples, t", t(top.bias_squared()), one.bias_squared()),
            ("slope, t", t(curve.slope(LEVEL).ok()), slope),
            ("slope, BCa", curve.slope_by_drawing(LEVEL).ok(), slope),
            ("efficiency ratio, 1 sample, t of logs", t(curve.log_efficiency_ratio(&rival, 0)), ratio(1)),
            ("efficiency ratio, 8 samples, t of logs", t(curve.log_efficiency_ratio(&rival, last)), ratio(8)),
        ];
        if found.is_empty() {
            found = tried.iter().map(|(what, ..)| Coverage { what, held: 0, of: 0, refused: 0 }).collect();
        }
        for (row, (_, interval, truth)) in found.iter_mut().zip(tried) {
            match interval {
                Some(interval) => {
                    row.of += 1;
                    row.held += usize::from(interval.holds(truth));
                }
                None => row.refused += 1,
            }
        }
    }
    found
}
