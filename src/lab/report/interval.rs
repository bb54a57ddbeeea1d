//! Estimates and the intervals about them.

use super::distribution::{normal_cdf, normal_point, student_point};
use crate::measure::draws::Draws;

/// The level of an interval that stands alone.
pub const LEVEL: f64 = 0.95;
/// How often a bootstrap draws.
const REPLICATES: usize = 1000;
/// The seed of all bootstraps: a report of the same runs gives the same intervals.
const BOOTSTRAP_SEED: u64 = 0x00b0_0757_0a95;

/// A value with the interval that holds the truth at its level, if what is assumed holds.
///
/// In JSON it is the three numbers in this order.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(from = "[f64; 3]", into = "[f64; 3]")]
pub struct Interval {
    /// The lower end.
    pub low: f64,
    /// The estimate itself.
    pub value: f64,
    /// The upper end.
    pub high: f64,
}

impl From<[f64; 3]> for Interval {
    fn from([low, value, high]: [f64; 3]) -> Self {
        Self { low, value, high }
    }
}

impl From<Interval> for [f64; 3] {
    fn from(Interval { low, value, high }: Interval) -> Self {
        [low, value, high]
    }
}

impl Interval {
    /// Whether it holds a number.
    pub fn holds(&self, truth: f64) -> bool {
        self.low <= truth && truth <= self.high
    }

    /// Of a number whose logarithm this is the interval of.
    pub fn of_logarithm(self) -> Self {
        let [low, value, high] = [self.low, self.value, self.high].map(libm::exp);
        Self { low, value, high }
    }
}

/// An estimate, the variance of the estimate itself, and how well that variance is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// The estimate's own variance: the square of its standard error.
    pub variance: f64,
    /// Degrees of freedom of that variance.
    pub freedom: f64,
}

impl Estimate {
    /// The t interval at a level.
    pub fn interval(&self, level: f64) -> Interval {
        let half = student_point(0.5 + 0.5 * level, self.freedom) * libm::sqrt(self.variance.max(0.0));
        Interval { low: self.value - half, value: self.value, high: self.value + half }
    }

    /// The t interval of its logarithm, brought back: never below 0, and fit for what varies by factors.
    ///
    /// None for a value that has no logarithm.
    pub fn log_interval(&self, level: f64) -> Option<Interval> {
        self.logarithm().map(|log| log.interval(level).of_logarithm())
    }

    /// This less another that is independent of it.
    pub fn less(&self, other: &Self) -> Self {
        let (variance, freedom) = joined(&[(self.variance, self.freedom), (other.variance, other.freedom)]);
        Self { value: self.value - other.value, variance, freedom }
    }

    /// Its logarithm, the variance to first order.
    pub fn logarithm(&self) -> Option<Self> {
        let positive = self.value > 0.0;
        positive.then(|| Self {
            value: libm::log(self.value),
            variance: self.variance / (self.value * self.value),
            freedom: self.freedom,
        })
    }
}

/// Variances of independent parts as one, with the freedom of Welch and Satterthwaite.
///
/// A part that two others both contain is given with a minus; the sum is never less than the largest of them.
pub fn joined(parts: &[(f64, f64)]) -> (f64, f64) {
    let largest = parts.iter().map(|part| part.0).fold(0.0, f64::max);
    let sum = parts.iter().map(|part| part.0).sum::<f64>().max(largest);
    let squares: f64 = parts.iter().map(|(variance, freedom)| variance * variance / freedom).sum();
    let min = parts.iter().map(|part| part.1).fold(f64::INFINITY, f64::min);
    (sum, if squares > 0.0 { (sum * sum / squares).max(1.0) } else { min })
}

/// The mean of independent values.
///
/// None of fewer than two, which have no variance.
pub fn mean_of(values: &[f64]) -> Option<Estimate> {
    let n = values.len() as f64;
    if values.len() < 2 {
        return None;
    }
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / (n - 1.0);
    Some(Estimate { value: mean, variance: variance / n, freedom: n - 1.0 })
}

/// A statistic of runs that are drawn alike, with the variance that leaving out one at a time shows (Tukey 1958).
///
/// `statistic` is asked with the weight of each run: all 1, then one of them 0. None where it has no value.
pub fn jackknife(count: usize, statistic: impl Fn(&[f64]) -> Option<f64>) -> Option<Estimate> {
    if count < 2 {
        return None;
    }
    let n = count as f64;
    let mut weights = vec![1.0; count];
    let value = statistic(&weights)?;
    let mut left_out = Vec::with_capacity(count);
    for run in 0..count {
        weights[run] = 0.0;
        left_out.push(statistic(&weights)?);
        weights[run] = 1.0;
    }
    let mean = left_out.iter().sum::<f64>() / n;
    let squares: f64 = left_out.iter().map(|other| (other - mean) * (other - mean)).sum();
    Some(Estimate { value, variance: squares * (n - 1.0) / n, freedom: n - 1.0 })
}

/// The interval of a statistic by drawing the runs anew with repetition, bias-corrected and accelerated (Efron 1987).
///
/// None where the statistic has no value, or has none in more than one draw of twenty.
pub fn bca(count: usize, level: f64, statistic: impl Fn(&[f64]) -> Option<f64>) -> Option<Interval> {
    let value = statistic(&vec![1.0; count])?;
    let mut draws = Draws::new(BOOTSTRAP_SEED, count as u64);
    let mut weights = vec![0.0; count];
    let mut drawn = Vec::with_capacity(REPLICATES);
    for _ in 0..REPLICATES {
        weights.fill(0.0);
        for _ in 0..count {
            weights[((draws.unit() * count as f64) as usize).min(count - 1)] += 1.0;
        }
        drawn.extend(statistic(&weights));
    }
    if count < 2 || drawn.len() * 20 < REPLICATES * 19 {
        return None;
    }
    drawn.sort_by(f64::total_cmp);
    let below = drawn.partition_point(|other| *other < value) as f64;
    let ties = drawn.partition_point(|other| *other <= value) as f64 - below;
    let below_value =
        ((below + 0.5 * ties) / drawn.len() as f64).clamp(0.5 / drawn.len() as f64, 1.0 - 0.5 / drawn.len() as f64);
    let (shift, acceleration) = (normal_point(below_value), acceleration(count, &statistic)?);
    let end = |tail: f64| {
        let z = shift + normal_point(tail);
        let quantile = normal_cdf(shift + z / (1.0 - acceleration * z));
        drawn[((quantile * drawn.len() as f64) as usize).min(drawn.len() - 1)]
    };
    let tail = 0.5 * (1.0 - level);
    Some(Interval { low: end(tail), value, high: end(1.0 - tail) })
}

/// A sixth of the skewness that leaving out one run at a time shows.
fn acceleration(count: usize, statistic: &impl Fn(&[f64]) -> Option<f64>) -> Option<f64> {
    let mut weights = vec![1.0; count];
    let mut left_out = Vec::with_capacity(count);
    for run in 0..count {
        weights[run] = 0.0;
        left_out.push(statistic(&weights)?);
        weights[run] = 1.0;
    }
    let mean = left_out.iter().sum::<f64>() / count as f64;
    let (mut squares, mut cubes) = (0.0, 0.0);
    for other in left_out {
        squares += (mean - other) * (mean - other);
        cubes += (mean - other) * (mean - other) * (mean - other);
    }
    Some(if squares > 0.0 { cubes / (6.0 * squares * libm::sqrt(squares)) } else { 0.0 })
}

/// The middle value; between the two middle ones where their number is even. None of nothing.
pub fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    let upper = sorted.get(middle)?;
    Some(if sorted.len() % 2 == 1 { *upper } else { 0.5 * (sorted[middle - 1] + upper) })
}

/// The median distance from the median: a spread that a few bad values do not move.
pub fn mad(values: &[f64]) -> Option<f64> {
    let middle = median(values)?;
    median(&values.iter().map(|value| (value - middle).abs()).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_has_the_textbook_interval() {
        let estimate = mean_of(&[1.0, 2.0, 3.0, 4.0, 5.0]).expect("five values");
        assert!((estimate.value - 3.0).abs() < 1e-15 && (estimate.variance - 0.5).abs() < 1e-15);
        let interval = estimate.interval(LEVEL);
        assert!((interval.high - 3.0 - 2.776_445 * libm::sqrt(0.5)).abs() < 1e-5, "{interval:?}");
        assert_eq!(mean_of(&[1.0]), None);
    }

    #[test]
    fn leaving_one_out_gives_the_variance_of_a_mean() {
        let values = [0.3, -1.0, 4.5, 2.0];
        let weighted = |weights: &[f64]| {
            let sum: f64 = weights.iter().zip(&values).map(|(weight, value)| weight * value).sum();
            Some(sum / weights.iter().sum::<f64>())
        };
        let (one, other) = (jackknife(4, weighted).expect("four"), mean_of(&values).expect("four"));
        assert!((one.variance - other.variance).abs() < 1e-14 && one.freedom == 3.0);
        let drawn = bca(4, LEVEL, weighted).expect("four");
        assert!(drawn.low < other.value && other.value < drawn.high);
    }

    #[test]
    fn medians_are_not_moved_by_one_bad_value() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&[4.0, 1.0, 2.0, 1e9]), Some(3.0));
        assert_eq!(mad(&[1.0, 2.0, 3.0, 4.0, 1e9]), Some(1.0));
        assert_eq!(median(&[]), None);
    }

    #[test]
    fn parts_join_as_welch_and_satterthwaite_have_it() {
        assert_eq!(joined(&[(2.0, 5.0)]), (2.0, 5.0));
        let (sum, freedom) = joined(&[(1.0, 4.0), (1.0, 4.0)]);
        assert_eq!((sum, freedom), (2.0, 8.0));
    }
}
