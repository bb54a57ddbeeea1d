//! The report as text: what a terminal and the book show.

use super::deviation::RELATIVE_MSE;
use super::interval::Interval;
use super::summary::{At, Report, Statistic};
use std::fmt;

/// A number in four digits.
pub fn short(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".into()
    } else if (1e-3..1e4).contains(&size) {
        let before = libm::floor(libm::log10(size)) as i32 + 1;
        format!("{value:.*}", (4 - before).clamp(0, 6) as usize)
    } else {
        format!("{value:.2e}")
    }
}

/// A number with half the width of its interval in percent, or a dash where it is refused.
pub fn with_percent(told: &Statistic) -> String {
    match told.value() {
        Some(Interval { low, value, high }) if value != 0.0 => {
            format!("{} ±{:.0}%", short(value), 50.0 * (high - low) / value.abs())
        }
        Some(interval) => short(interval.value),
        None => "refused".into(),
    }
}

/// A number that may be near 0, with half the width of its interval.
pub fn with_half(told: &Statistic) -> String {
    match told.value() {
        Some(Interval { low, value, high }) => format!("{} ±{}", short(value), short(0.5 * (high - low))),
        None => "refused".into(),
    }
}

/// A number with the ends of its interval.
pub fn with_ends(told: &Statistic) -> String {
    match told {
        Statistic::Value(Interval { low, value, high }) => {
            format!("{} ({} to {})", short(*value), short(*low), short(*high))
        }
        Statistic::Refused(what) => what.clone(),
    }
}

/// The slope, or that there is none and why.
pub fn slope_words(slope: &Statistic) -> String {
    match slope {
        Statistic::Value(_) => format!("slope {}", with_ends(slope)),
        Statistic::Refused(what) if what.starts_with("no slope") => what.clone(),
        Statistic::Refused(what) => format!("no slope: {what}"),
    }
}

/// What the comparisons are read at.
pub fn at_words(at: At) -> String {
    match at {
        At::Samples(samples) => format!("{samples} samples"),
        At::Seconds(seconds) => format!("{} s", short(seconds)),
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([width, height], ladder) = (self.size, &self.ladder);
        writeln!(
            f,
            "{}: {width} x {height} pixels, {} seeds a level; reference of {} samples in {} batches",
            self.name,
            ladder.seeds,
            ladder.reference_samples(),
            ladder.batches
        )?;
        for variant in &self.variants {
            writeln!(f, "\n{}", variant.name)?;
            writeln!(
                f,
                "{:>7}  {:<14} {:<14} {:<18} {:>9} {:>9}  {:<14} {:>9}",
                "samples", "MSE", "variance", "bias²", "relMSE", "ms CPU", "1/(MSE·T)", "top 0.1 %"
            )?;
            for level in &variant.levels {
                writeln!(
                    f,
                    "{:>7}  {:<14} {:<14} {:<18} {:>9} {:>9}  {:<14} {:>7.1} %",
                    level.samples,
                    with_percent(&level.mse),
                    with_percent(&level.variance),
                    with_half(&level.bias_squared),
                    short(level.rel_mse),
                    short(1e3 * level.render.median.value),
                    with_percent(&level.efficiency),
                    100.0 * level.tail_fraction
                )?;
            }
            writeln!(f, "{}", slope_words(&variant.slope))?;
        }
        if !self.comparisons.is_empty() {
            let first = self.variants.first().map_or("the first", |variant| &variant.name);
            writeln!(
                f,
                "\nagainst {first}; each interval at {:.2} %, so that all hold with 95 %",
                100.0 * self.family_level
            )?;
            writeln!(f, "{:<24} {:<14} {:<30} efficiency ratio", "", "at equal", "MSE ratio")?;
            for row in &self.comparisons {
                let efficiency = row.efficiency.as_ref().map_or_else(|| "-".into(), with_ends);
                writeln!(f, "{:<24} {:<14} {:<30} {efficiency}", row.variant, at_words(row.at), with_ends(&row.mse))?;
            }
        }
        writeln!(f, "\n± is half the interval at 95 %; V_ref subtracted; {RELATIVE_MSE}")?;
        writeln!(f, "{}", self.provenance.measured())?;
        self.flags.iter().try_for_each(|flag| writeln!(f, "flag: {flag}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_digits() {
        let cases = [(0.0, "0"), (0.012_345, "0.01235"), (3.0, "3.000"), (123.456, "123.5"), (4.2e-7, "4.20e-7")];
        for (value, text) in cases {
            assert_eq!(short(value), text);
        }
        assert_eq!(with_percent(&Statistic::Value(Interval { low: 1.0, value: 2.0, high: 3.0 })), "2.000 ±50%");
        assert_eq!(with_percent(&Statistic::Refused("no".into())), "refused");
    }

    #[test]
    fn a_slope_that_is_refused_is_not_told_as_a_slope() {
        assert_eq!(
            slope_words(&Statistic::Value(Interval { low: -1.5, value: -1.0, high: -0.5 })),
            "slope -1.000 (-1.500 to -0.5000)"
        );
        for what in ["no slope: 0 has no logarithm", "0 has no logarithm"] {
            assert_eq!(slope_words(&Statistic::Refused(what.into())), "no slope: 0 has no logarithm");
        }
    }
}
