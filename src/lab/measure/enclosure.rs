//! Numbers enclosed: a pair of f64, about 106 bits, and a radius that the true number cannot lie beyond.
//!
//! Reads: f64 inputs, taken exactly. Writes: signs and rounded values where the radius allows, nothing where it does
//! not; then exact arithmetic decides. Pinhole's own pairs in `intersect` share no line with these.
//!
//! With u = 2⁻⁵³ and |low| ≤ u|high|, a sum as done here is off by less than 4u² of itself and a product by less than
//! 8u² (Joldes, Muller and Popescu, *Tight and rigorous error bounds for basic building blocks of double-word
//! arithmetic*, 2017, theorems 3.1 and 5.1, the product there with a fused step less). Radii take 16u² for both.
//! Quotients and roots are checked by what multiplying back leaves, however they were found. What a radius loses by
//! its own rounding, and what any pair loses below 2⁻⁹⁰⁰, is made good by a factor and a floor.

use super::exact::Dyadic;
use super::number::Number;
use std::sync::LazyLock;

/// The number lies within `radius` of `high` + `low`; a radius that is NaN says nothing.
#[derive(Clone, Copy, Debug)]
pub struct Enclosure {
    high: f64,
    low: f64,
    radius: f64,
}

/// 16u², relative to the result of a sum or a product.
const ROUNDING: f64 = 1.0 / (1_u128 << 102) as f64;
/// More than the few roundings of a radius can take away.
const GROWN: f64 = 1.0 + 1.0 / (1_u64 << 48) as f64;
/// Below this, the second half of a product may be lost: 2⁻⁹⁰⁰.
const SMALL: f64 = f64::from_bits((1023 - 900) << 52);
/// More than what is lost there: 2⁻¹⁰⁰⁰.
const FLOOR: f64 = f64::from_bits((1023 - 1000) << 52);

/// a + b without any error (Knuth).
#[inline(always)]
fn exact_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// a · b without any error but underflow (Dekker, by halves of Veltkamp).
#[inline(always)]
fn exact_product(a: f64, b: f64) -> (f64, f64) {
    let halves = |x: f64| {
        let spread = x * 134_217_729.0;
        let high = spread - (spread - x);
        (high, x - high)
    };
    let (product, (a1, a2), (b1, b2)) = (a * b, halves(a), halves(b));
    (product, a2 * b2 - (((product - a1 * b1) - a2 * b1) - a1 * b2))
}

impl Enclosure {
    fn exact(value: f64) -> Self {
        Self { high: value, low: 0.0, radius: 0.0 }
    }

    /// The exact number, enclosed.
    pub fn of_exact(value: &Dyadic) -> Self {
        let high = value.to_f64();
        let low = (value - &Dyadic::of(high)).to_f64();
        Self { high, low, radius: high.abs() * ROUNDING + FLOOR }
    }

    /// The same number, less surely.
    fn widened(self, relative: f64) -> Self {
        Self { radius: (self.radius + self.high.abs() * relative) * GROWN, ..self }
    }

    /// No more than what the number's magnitude can be.
    fn max(&self) -> f64 {
        (self.high.abs() + self.radius) * GROWN
    }

    fn is_exact(&self) -> bool {
        self.low == 0.0 && self.radius == 0.0
    }
}

impl Number for Enclosure {
    fn of(value: f64) -> Self {
        Self::exact(value)
    }

    /// By the series of sine and cosine below 45 degrees, and turned over above.
    fn tan_of_half(full_degrees: f64) -> Self {
        let half = Self::exact(full_degrees / 2.0);
        if full_degrees > 90.0 {
            return Self::exact(1.0).over(&tan_below_45(&Self::exact(90.0).less(&half)));
        }
        tan_below_45(&half)
    }

    #[inline]
    fn plus(&self, other: &Self) -> Self {
        let (sum, error) = exact_sum(self.high, other.high);
        if self.is_exact() && other.is_exact() {
            return Self { high: sum, low: error, radius: 0.0 * sum };
        }
        let (low, lower) = exact_sum(self.low, other.low);
        let (sum, error) = exact_sum(sum, error + low);
        let (high, low) = exact_sum(sum, error + lower);
        Self { high, low, radius: (self.radius + other.radius + high.abs() * ROUNDING) * GROWN }
    }

    fn less(&self, other: &Self) -> Self {
        self.plus(&Self { high: -other.high, low: -other.low, radius: other.radius })
    }

    #[inline]
    fn by(&self, other: &Self) -> Self {
        let (product, error) = exact_product(self.high, other.high);
        let floor = if product.abs() < SMALL && self.high != 0.0 && other.high != 0.0 { FLOOR } else { 0.0 };
        if self.is_exact() && other.is_exact() {
            return Self { high: product, low: error, radius: floor + 0.0 * product };
        }
        let (high, low) = exact_sum(product, error + (self.high * other.low + self.low * other.high));
        let spread = self.max() * other.radius + self.radius * other.high.abs() * GROWN;
        let floor = if self.radius > 0.0 || other.radius > 0.0 { FLOOR } else { floor };
        Self { high, low, radius: (spread + high.abs() * ROUNDING) * GROWN + floor }
    }

    fn over(&self, divisor: &Self) -> Self {
        let first = self.high / divisor.high;
        let rest = self.less(&divisor.by(&Self::exact(first)));
        let (high, low) = exact_sum(first, rest.high / divisor.high);
        let quotient = Self { high, low, radius: 0.0 };
        // What is left of a after taking away q b, over the least that b can be, is how far q is off.
        let rest = self.less(&divisor.by(&quotient));
        let min = divisor.high.abs() / GROWN - divisor.radius * GROWN;
        let radius = if min > 0.0 { rest.most_exactly() / min * GROWN } else { f64::INFINITY };
        Self { radius: if radius == 0.0 { 0.0 } else { radius + FLOOR }, ..quotient }
    }

    fn root(&self) -> Self {
        if self.is_exact() && self.high == 0.0 {
            return *self;
        }
        let first = self.high.sqrt();
        let rest = self.less(&Self::exact(first).by(&Self::exact(first)));
        let (high, low) = exact_sum(first, rest.high / (2.0 * first));
        let root = Self { high, low, radius: 0.0 };
        // |√x − s| = |x − s²| / (√x + s) ≤ |x − s²| / s.
        let rest = self.less(&root.by(&root));
        let radius = rest.most_exactly() / high * (GROWN * GROWN);
        Self { radius: if radius == 0.0 { 0.0 } else { radius + FLOOR }, ..root }
    }

    fn sign(&self) -> Option<i32> {
        if self.high == 0.0 && self.radius == 0.0 {
            return Some(0);
        }
        let clear = self.high.abs() > (self.low.abs() + self.radius) * GROWN;
        clear.then_some(if self.high > 0.0 { 1 } else { -1 })
    }

    /// High is the nearest f64 unless half a step away lies within reach.
    fn rounded(&self) -> Option<f64> {
        let step = (self.high.next_up() - self.high).min(self.high - self.high.next_down());
        let far = 2.0 * (self.low.abs() + self.radius) * GROWN;
        // A zero has no sign here, as it has none in exact arithmetic.
        (far < step && self.high.is_finite()).then_some(self.high + 0.0)
    }

    fn about(&self) -> Option<f64> {
        const ENOUGH: f64 = 1.0 / (1_u64 << 21) as f64;
        let sure = self.radius <= self.high.abs() * ENOUGH && self.high.is_finite();
        sure.then_some(self.high)
    }
}

impl Enclosure {
    /// As [`Self::max`], with nothing added to an exact 0.
    fn most_exactly(&self) -> f64 {
        if self.high == 0.0 && self.radius == 0.0 { 0.0 } else { self.max() }
    }
}

/// π / 180.
static RADIANS: LazyLock<Enclosure> =
    LazyLock::new(|| Enclosure::of_exact(&super::exact_angle::pi().divided_by(&Dyadic::of(180))));

/// 1 / n!, n from 0 to 29.
static INVERSE_FACTORIALS: LazyLock<Vec<Enclosure>> = LazyLock::new(|| {
    let mut factorial = Dyadic::of(1);
    let inverse = |n: i32| {
        factorial = &factorial * &Dyadic::of(n.max(1));
        Enclosure::of_exact(&Dyadic::of(1).divided_by(&factorial))
    };
    (0..30).map(inverse).collect()
});

/// Up to x²⁹ / 29! and x²⁸ / 28!; for x up to π/4 the first terms left out are below 2⁻¹¹⁷ of the sums.
fn tan_below_45(degrees: &Enclosure) -> Enclosure {
    const LEFT_OUT: f64 = 1.0 / (1_u128 << 116) as f64;
    let angle = degrees.by(&RADIANS);
    let square = angle.by(&angle);
    let series = |first: usize| {
        let last = INVERSE_FACTORIALS[28 + first];
        let step = |sum: Enclosure, n: usize| INVERSE_FACTORIALS[n].less(&sum.by(&square));
        (first..28 + first).step_by(2).rev().fold(last, step).widened(LEFT_OUT)
    };
    angle.by(&series(1)).over(&series(0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::exact::relative_error;
    use proptest::prelude::*;

    /// Whether the exact number lies inside, and what is told of it is so.
    fn holds(enclosed: &Enclosure, exact: &Dyadic) -> bool {
        if !enclosed.high.is_finite() || !enclosed.low.is_finite() || !enclosed.radius.is_finite() {
            return Number::sign(enclosed).is_none() && enclosed.rounded().is_none() && enclosed.about().is_none();
        }
        let middle = &Dyadic::of(enclosed.high) + &Dyadic::of(enclosed.low);
        let inside = (exact - &middle).abs() <= Dyadic::of(enclosed.radius);
        let sign = Number::sign(enclosed).is_none_or(|sign| sign == exact.sign());
        let rounded = enclosed.rounded().is_none_or(|rounded| rounded.to_bits() == exact.to_f64().to_bits());
        inside && sign && rounded && enclosed.about().is_none_or(|about| relative_error(about, exact) < 1e-6)
    }

    /// A number of any size, or one that differs from another in its last bits only.
    fn numbers() -> impl Strategy<Value = [f64; 4]> {
        let any = (-1.0..1.0_f64, -300..300_i32).prop_map(|(digits, power)| libm::ldexp(digits, power));
        let small = (-1.0..1.0_f64, -6..6_i32).prop_map(|(digits, power)| libm::ldexp(digits, power));
        let near = (small, -4..4_i64)
            .prop_map(|(value, steps)| f64::from_bits((value.to_bits() as i64 + steps) as u64))
            .prop_filter("a number", |value| value.is_finite());
        let whole = (-9..9_i32).prop_map(f64::from);
        let one = prop_oneof![any, near, whole];
        [one.clone(), one.clone(), one.clone(), one]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]
        #[test]
        fn what_is_told_of_a_number_is_so([a, b, c, d] in numbers()) {
            let of = |value: f64| (Enclosure::exact(value), Dyadic::of(value));
            let ((a, exact_a), (b, exact_b), (c, exact_c), (d, exact_d)) = (of(a), of(b), of(c), of(d));
            let cases = [
                (a.plus(&b), &exact_a + &exact_b),
                (a.by(&b).less(&c.by(&d)), &(&exact_a * &exact_b) - &(&exact_c * &exact_d)),
                (a.plus(&b).by(&c.plus(&d)), &(&exact_a + &exact_b) * &(&exact_c + &exact_d)),
                (a.by(&b).by(&c.by(&d)), &(&exact_a * &exact_b) * &(&exact_c * &exact_d)),
            ];
            for (enclosed, exact) in &cases {
                prop_assert!(holds(enclosed, exact), "{enclosed:?}, {}", exact.to_f64());
                let (square, exact_square) = (enclosed.by(enclosed), exact.squared());
                prop_assert!(holds(&square, &exact_square));
                prop_assert!(holds(&square.root(), &exact_square.square_root()));
                for (divisor, exact_divisor) in &cases {
                    if exact_divisor.sign() != 0 {
                        prop_assert!(holds(&enclosed.over(divisor), &exact.divided_by(exact_divisor)));
                    }
                }
            }
        }

        #[test]
        fn tangents_are_enclosed(degrees in prop_oneof![1e-4..180.0, 1e-9..1e-3, 179.99..180.0]) {
            let enclosed = Enclosure::tan_of_half(degrees);
            prop_assert!(holds(&enclosed, &Dyadic::tan_of_half(degrees)), "{degrees}");
            prop_assert!(enclosed.rounded().is_some());
        }
    }
}
