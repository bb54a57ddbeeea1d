//! Whether counts are what a pdf says: Pearson's χ², and the probability of one so large.

/// How often each of a number of things was expected and how often it was counted.
#[derive(Clone, Debug)]
pub struct Bins {
    expected: Vec<f64>,
    counted: Vec<u64>,
}

/// Bins expected to hold fewer are put together, for the approximation needs some in each.
const FEWEST: f64 = 5.0;

impl Bins {
    /// So many bins, expected empty and empty.
    #[must_use]
    pub fn new(bins: usize) -> Self {
        Self { expected: vec![0.0; bins], counted: vec![0; bins] }
    }

    /// Adds to what is expected of a bin.
    pub fn expect(&mut self, bin: usize, count: f64) {
        self.expected[bin] += count;
    }

    /// Counts one in a bin.
    pub fn count(&mut self, bin: usize) {
        self.counted[bin] += 1;
    }

    /// The sum of all that is expected.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.expected.iter().sum()
    }

    /// Σ (counted − expected)² / expected, and its degrees of freedom: one less than there are bins.
    ///
    /// Bins in which fewer than five are expected are put together in order of size until there are; something counted in
    /// a bin in which nothing is expected is infinitely far off.
    #[must_use]
    pub fn statistic(&self) -> (f64, usize) {
        let mut order: Vec<usize> = (0..self.expected.len()).collect();
        order.sort_by(|&a, &b| self.expected[a].total_cmp(&self.expected[b]));
        let (mut sum, mut bins) = (0.0, 0_usize);
        let (mut expected, mut counted) = (0.0, 0_u64);
        for bin in order {
            if self.expected[bin] <= 0.0 && self.counted[bin] > 0 {
                return (f64::INFINITY, self.expected.len() - 1);
            }
            expected += self.expected[bin];
            counted += self.counted[bin];
            if expected >= FEWEST {
                let off = counted as f64 - expected;
                sum += off * off / expected;
                bins += 1;
                (expected, counted) = (0.0, 0);
            }
        }
        (sum, bins.saturating_sub(1))
    }
}

/// The probability that a χ² of so many degrees of freedom is at least as large: Q(freedom / 2, statistic / 2).
#[must_use]
pub fn p_value(statistic: f64, freedom: usize) -> f64 {
    if freedom == 0 { 1.0 } else { upper_gamma(0.5 * freedom as f64, 0.5 * statistic.min(1e9)) }
}

/// The regularised upper incomplete gamma function Q(a, x) = Γ(a, x) / Γ(a), for a > 0 and x ≥ 0.
///
/// Below a + 1 by the series of its complement, above by Lentz's evaluation of the continued fraction.
#[must_use]
pub fn upper_gamma(a: f64, x: f64) -> f64 {
    const STEPS: u32 = 100_000;
    if x <= 0.0 {
        return 1.0;
    }
    let scale = libm::exp(a * libm::log(x) - x - libm::lgamma(a));
    if x < a + 1.0 {
        let (mut term, mut sum) = (1.0 / a, 1.0 / a);
        for step in 1..STEPS {
            term *= x / (a + f64::from(step));
            sum += term;
            if term < sum * f64::EPSILON {
                break;
            }
        }
        return (1.0 - sum * scale).clamp(0.0, 1.0);
    }
    const TINY: f64 = 1e-300;
    let mut b = x + 1.0 - a;
    let (mut c, mut d) = (1.0 / TINY, 1.0 / b);
    let mut fraction = d;
    for step in 1..STEPS {
        let step = f64::from(step);
        let numerator = step * (a - step);
        b += 2.0;
        let away_from_zero = |value: f64| if value.abs() < TINY { TINY } else { value };
        d = 1.0 / away_from_zero(numerator * d + b);
        c = away_from_zero(b + numerator / c);
        fraction *= c * d;
        if (c * d - 1.0).abs() < f64::EPSILON {
            break;
        }
    }
    (fraction * scale).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;

    /// For an even number of degrees of freedom 2k, Q is e^(−x) Σ xⁱ/i! over i < k.
    #[test]
    fn even_degrees_of_freedom_have_a_closed_form() {
        let (mut worst, mut tried) = (0.0_f64, 0);
        for k in [1_u32, 2, 3, 10, 50, 200] {
            for step in 1..60 {
                let x = f64::from(k) * f64::from(step) / 20.0;
                let mut logarithm = -x;
                let mut exact = 0.0;
                for i in 0..k {
                    exact += libm::exp(logarithm);
                    logarithm += libm::log(x / f64::from(i + 1));
                }
                let value = p_value(2.0 * x, 2 * k as usize);
                worst = worst.max((value - exact).abs());
                tried += 1;
            }
        }
        eprintln!("p-values: {tried} of even degrees of freedom, worst {worst:.1e} off");
        assert!(worst < 1e-11, "{worst}");
    }

    /// One degree of freedom: erfc(√(x / 2)). And quantiles as tables have them.
    #[test]
    fn known_quantiles() {
        for step in 1..200 {
            let x = f64::from(step) * 0.2;
            assert!((p_value(x, 1) - libm::erfc((0.5 * x).sqrt())).abs() < 1e-13, "{x}");
        }
        for (statistic, freedom, p) in [
            (3.841_458_820_694_124, 1, 0.05),
            (6.634_896_601_021_213, 1, 0.01),
            (18.307_038_053_275_146, 10, 0.05),
            (24.995_790_139_728_616, 15, 0.05),
            (124.342_113_404_004_07, 100, 0.05),
        ] {
            let found = p_value(statistic, freedom);
            assert!((found - p).abs() < 1e-9, "{statistic} of {freedom}: {found}");
        }
        assert_eq!([p_value(0.0, 7), p_value(5.0, 0)], [1.0, 1.0]);
        assert!(p_value(1e4, 10) == 0.0 && p_value(f64::INFINITY, 10) == 0.0);
    }

    /// Fair dice pass as often as they should, and a loaded one does not.
    #[test]
    fn p_values_of_fair_dice_are_spread_evenly() {
        const GAMES: u64 = 400;
        const THROWS: u64 = 6000;
        let game = |seed, index, loaded: f64| {
            let mut bins = Bins::new(6);
            (0..6).for_each(|face| bins.expect(face, THROWS as f64 / 6.0));
            let mut draws = Draws::new(seed, index);
            (0..THROWS).for_each(|_| bins.count(((draws.unit() + loaded).min(0.999) * 6.0) as usize));
            let (statistic, freedom) = bins.statistic();
            assert_eq!(freedom, 5);
            p_value(statistic, freedom)
        };
        let mut spread = Bins::new(10);
        (0..10).for_each(|tenth| spread.expect(tenth, GAMES as f64 / 10.0));
        (0..GAMES).for_each(|index| spread.count((game(195, index, 0.0) * 10.0).min(9.0) as usize));
        let (statistic, freedom) = spread.statistic();
        let p = p_value(statistic, freedom);
        eprintln!("dice: {GAMES} games of {THROWS} throws, p-values spread with p {p:.3}");
        assert!(p > 1e-3);
        assert!(game(196, 0, 0.02) < 1e-6, "a die loaded by 2 % passes");
    }

    #[test]
    fn small_bins_are_put_together_and_impossible_ones_tell() {
        let mut bins = Bins::new(12);
        (0..12).for_each(|bin| bins.expect(bin, if bin < 10 { 1.0 } else { 20.0 }));
        (0..10).for_each(|bin| bins.count(bin));
        (0..40).for_each(|at| bins.count(10 + at % 2));
        assert_eq!(bins.statistic(), (0.0, 3), "two bins of five ones, two of twenty");
        let mut never = Bins::new(3);
        never.expect(0, 50.0);
        never.expect(1, 50.0);
        (0..50).for_each(|_| [0, 1].into_iter().for_each(|bin| never.count(bin)));
        assert_eq!(never.statistic(), (0.0, 1));
        never.count(2);
        let (statistic, freedom) = never.statistic();
        assert_eq!(p_value(statistic, freedom), 0.0);
    }
}
