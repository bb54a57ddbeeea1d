//! The normal distribution and Student's t, as far as intervals need them.

use std::f64::consts::SQRT_2;

/// The cumulative distribution function of the standard normal distribution: the probability of a value below z.
pub fn normal_cdf(z: f64) -> f64 {
    0.5 * libm::erfc(-z / SQRT_2)
}

/// The quantile of the standard normal distribution: the z below which a value lies with this probability.
pub fn normal_point(probability: f64) -> f64 {
    point_of(normal_cdf, probability)
}

/// The cumulative distribution function of Student's t; the freedom need not be whole (Welch–Satterthwaite).
pub fn student_cdf(t: f64, freedom: f64) -> f64 {
    let tail = 0.5 * regularised_beta(freedom / (freedom + t * t), freedom / 2.0, 0.5);
    if t > 0.0 { 1.0 - tail } else { tail }
}

/// The quantile of Student's t: the t below which a value lies with this probability.
pub fn student_point(probability: f64, freedom: f64) -> f64 {
    point_of(|t| student_cdf(t, freedom), probability)
}

/// The level of each of so many intervals at which all hold together with the level of the family (Šidák 1967).
pub fn sidak(family: f64, comparisons: usize) -> f64 {
    libm::pow(family, 1.0 / comparisons.max(1) as f64)
}

/// Where a distribution function reaches a probability: the bracket doubles until it holds the point, then halves.
fn point_of(cdf: impl Fn(f64) -> f64, probability: f64) -> f64 {
    let mut far = 1.0;
    while far < 1e12 && (cdf(-far) > probability || cdf(far) < probability) {
        far *= 2.0;
    }
    let (mut low, mut high) = (-far, far);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if cdf(middle) < probability { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The regularised incomplete beta function, by Lentz's continued fraction (Abramowitz and Stegun 26.5.8).
fn regularised_beta(x: f64, a: f64, b: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return x.clamp(0.0, 1.0);
    }
    // The fraction converges fast below the mean; above it the complement does.
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - regularised_beta(1.0 - x, b, a);
    }
    let front = a * libm::log(x) + b * libm::log1p(-x) + libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b);
    libm::exp(front) / (a * beta_fraction(x, a, b))
}

fn beta_fraction(x: f64, a: f64, b: f64) -> f64 {
    const TINY: f64 = 1e-300;
    let away = |value: f64| if value.abs() < TINY { TINY } else { value };
    let (mut fraction, mut c, mut d) = (1.0, 1.0, 0.0);
    for step in 1..500 {
        let m = f64::from(step / 2);
        let numerator = if step % 2 == 0 {
            m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m))
        } else {
            -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0))
        };
        d = 1.0 / away(1.0 + numerator * d);
        c = away(1.0 + numerator / c);
        fraction *= c * d;
        if (c * d - 1.0).abs() < 1e-15 {
            break;
        }
    }
    fraction
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_those_of_the_tables() {
        // Abramowitz and Stegun, tables 26.1 and 26.10.
        let known = [(1.0, 0.975, 12.706), (5.0, 0.975, 2.571), (15.0, 0.975, 2.131), (7.0, 0.995, 3.499)];
        for (freedom, probability, t) in known {
            let point = student_point(probability, freedom);
            assert!((point - t).abs() < 6e-4, "{freedom}: {point}");
        }
        assert!((normal_point(0.975) - 1.959_963_984_540_054).abs() < 1e-9);
        assert!((normal_point(0.5)).abs() < 1e-12);
        assert!((student_point(0.975, 1e7) - normal_point(0.975)).abs() < 1e-6);
    }

    #[test]
    fn probabilities_are_those_of_closed_forms() {
        let mut tried = 0;
        for step in -400..=400 {
            let t = f64::from(step) / 20.0;
            // Freedom 1 is Cauchy's distribution, freedom 2 has a closed form too.
            let cauchy = 0.5 + libm::atan(t) / std::f64::consts::PI;
            let second = 0.5 + t / (2.0 * libm::sqrt(2.0 + t * t));
            assert!((student_cdf(t, 1.0) - cauchy).abs() < 1e-12, "t {t}");
            assert!((student_cdf(t, 2.0) - second).abs() < 1e-12, "t {t}");
            tried += 2;
        }
        eprintln!("student: {tried} probabilities against closed forms");
    }

    #[test]
    fn a_family_of_one_keeps_its_level() {
        assert!((sidak(0.95, 1) - 0.95).abs() < 1e-15);
        assert!((libm::pow(sidak(0.95, 10), 10.0) - 0.95).abs() < 1e-14);
    }
}
