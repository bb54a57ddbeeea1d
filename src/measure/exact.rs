//! Exact arithmetic on dyadic numbers: whole numbers times powers of two.
//!
//! Every finite f32 and f64 is dyadic, and so is every sum and product of dyadics; an oracle that only adds,
//! multiplies and asks for signs therefore never rounds. Quotients, roots and tangents are not dyadic: they
//! are rounded, with a relative error below 2^-300.

use num_bigint::{BigInt, Sign};
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// The bits that a quotient or a square root keeps.
const PRECISION: i64 = 320;

/// The number mantissa · 2^exponent, with no limit on the mantissa.
#[derive(Clone, Debug)]
pub struct Dyadic {
    /// The whole number that carries the sign and all digits.
    pub mantissa: BigInt,
    /// The power of two it is scaled by.
    pub exponent: i32,
}

impl Dyadic {
    /// The exact value of an f32, an f64 or an i32.
    ///
    /// # Panics
    /// When the value is not finite: infinity has no exact value to judge by.
    #[must_use]
    pub fn of(value: impl Into<f64>) -> Self {
        let value: f64 = value.into();
        assert!(value.is_finite(), "only a finite number has an exact value");
        let (bits, stored) = (value.to_bits(), ((value.to_bits() >> 52) & 0x7ff) as i32);
        let fraction = bits & ((1 << 52) - 1);
        let whole = if stored == 0 { fraction } else { fraction | (1 << 52) };
        // Trailing zeros go into the exponent so that mantissas stay short.
        let zeros = if whole == 0 { 0 } else { whole.trailing_zeros() };
        let magnitude = BigInt::from(whole >> zeros);
        let mantissa = if value < 0.0 { -magnitude } else { magnitude };
        Self { mantissa, exponent: stored.max(1) - 1075 + zeros as i32 }
    }

    /// This number times 2^power, exactly.
    #[must_use]
    pub fn scaled(&self, power: i32) -> Self {
        Self { mantissa: self.mantissa.clone(), exponent: self.exponent + power }
    }

    /// −1, 0 or 1.
    #[must_use]
    pub fn sign(&self) -> i32 {
        match self.mantissa.sign() {
            Sign::Minus => -1,
            Sign::NoSign => 0,
            Sign::Plus => 1,
        }
    }

    /// The number without its sign.
    #[must_use]
    pub fn abs(&self) -> Self {
        if self.sign() < 0 { -self } else { self.clone() }
    }

    /// The number times itself, exactly.
    #[must_use]
    pub fn squared(&self) -> Self {
        self * self
    }

    /// The nearest f64, ties to even; subnormals and overflow to infinity as IEEE 754 has them.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        let exponent = i64::from(self.exponent);
        // The last place an f64 of this size can hold, never below the smallest subnormal.
        let last_place = (self.mantissa.bits() as i64 + exponent - 53).max(-1074);
        let dropped = last_place - exponent;
        let magnitude = self.mantissa.magnitude();
        let mut kept = if dropped <= 0 { magnitude << -dropped } else { magnitude >> dropped };
        if dropped > 0 && magnitude.bit(dropped as u64 - 1) {
            let more_than_half = magnitude.trailing_zeros().is_some_and(|zeros| (zeros as i64) < dropped - 1);
            if more_than_half || kept.bit(0) {
                kept += 1u32;
            }
        }
        let whole = kept.iter_u64_digits().next().unwrap_or(0) as f64;
        let rounded = libm::ldexp(whole, last_place.min(4096) as i32);
        if self.sign() < 0 { -rounded } else { rounded }
    }

    /// This number shortened to `PRECISION` bits, towards minus infinity.
    fn shortened(&self) -> Self {
        let surplus = (self.mantissa.bits() as i64 - PRECISION).max(0);
        Self { mantissa: &self.mantissa >> surplus, exponent: self.exponent + surplus as i32 }
    }

    /// The quotient, with a relative error below 2^-319.
    ///
    /// # Panics
    /// When the divisor is zero.
    #[must_use]
    pub fn divided_by(&self, divisor: &Self) -> Self {
        let (own, other) = (self.mantissa.bits() as i64, divisor.mantissa.bits() as i64);
        let shift = (PRECISION + 1 + other - own).max(0);
        let mantissa = (&self.mantissa << shift) / &divisor.mantissa;
        Self { mantissa, exponent: self.exponent - divisor.exponent - shift as i32 }
    }

    /// The square root, with a relative error below 2^-319.
    ///
    /// # Panics
    /// When the number is negative.
    #[must_use]
    pub fn square_root(&self) -> Self {
        let mut shift = (2 * PRECISION - self.mantissa.bits() as i64).max(0);
        // An even exponent halves exactly.
        shift += (i64::from(self.exponent) - shift).rem_euclid(2);
        let exponent = (i64::from(self.exponent) - shift) / 2;
        Self { mantissa: (&self.mantissa << shift).sqrt(), exponent: exponent as i32 }
    }
}

impl Add for &Dyadic {
    type Output = Dyadic;
    fn add(self, other: &Dyadic) -> Dyadic {
        let exponent = self.exponent.min(other.exponent);
        let aligned = |term: &Dyadic| &term.mantissa << (term.exponent - exponent);
        Dyadic { mantissa: aligned(self) + aligned(other), exponent }
    }
}

impl Mul for &Dyadic {
    type Output = Dyadic;
    fn mul(self, other: &Dyadic) -> Dyadic {
        Dyadic { mantissa: &self.mantissa * &other.mantissa, exponent: self.exponent + other.exponent }
    }
}

impl Neg for &Dyadic {
    type Output = Dyadic;
    fn neg(self) -> Dyadic {
        Dyadic { mantissa: -&self.mantissa, exponent: self.exponent }
    }
}

impl Sub for &Dyadic {
    type Output = Dyadic;
    fn sub(self, other: &Dyadic) -> Dyadic {
        self + &-other
    }
}

impl PartialEq for Dyadic {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Dyadic {}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Self) -> Ordering {
        (self - other).sign().cmp(&0)
    }
}

/// A point or a vector of three exact numbers, in whatever space its source was.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactVector {
    /// The x component.
    pub x: Dyadic,
    /// The y component.
    pub y: Dyadic,
    /// The z component.
    pub z: Dyadic,
}

impl ExactVector {
    /// The exact value of three floating point numbers, f32 or f64.
    ///
    /// # Panics
    /// When a component is not finite.
    #[must_use]
    pub fn of<T: Into<f64>>(components: impl Into<[T; 3]>) -> Self {
        let [x, y, z] = components.into().map(Dyadic::of);
        Self { x, y, z }
    }

    /// The scalar product, exactly.
    #[must_use]
    pub fn dot(&self, other: &Self) -> Dyadic {
        &(&(&self.x * &other.x) + &(&self.y * &other.y)) + &(&self.z * &other.z)
    }

    /// The vector product, exactly.
    #[must_use]
    pub fn cross(&self, other: &Self) -> Self {
        let area = |a: &Dyadic, b: &Dyadic, c: &Dyadic, d: &Dyadic| &(a * d) - &(b * c);
        Self {
            x: area(&self.y, &self.z, &other.y, &other.z),
            y: area(&self.z, &self.x, &other.z, &other.x),
            z: area(&self.x, &self.y, &other.x, &other.y),
        }
    }

    /// This vector minus the other, exactly.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        Self { x: &self.x - &other.x, y: &self.y - &other.y, z: &self.z - &other.z }
    }

    /// Each component times the factor, exactly.
    #[must_use]
    pub fn times(&self, factor: &Dyadic) -> Self {
        Self { x: &self.x * factor, y: &self.y * factor, z: &self.z * factor }
    }

    /// The length, with a relative error below 2^-319.
    #[must_use]
    pub fn length(&self) -> Dyadic {
        self.dot(self).square_root()
    }
}

/// π, with a relative error below 2^-310, by Machin's formula 16 atan(1/5) − 4 atan(1/239).
#[must_use]
pub fn pi() -> Dyadic {
    let one = BigInt::from(1) << (PRECISION + 32);
    let arctangent_of_one_over = |whole: i64| {
        let (mut power, mut sum, mut odd) = (&one / whole, BigInt::ZERO, 1i64);
        while power != BigInt::ZERO {
            sum += if odd % 4 == 1 { &power / odd } else { -(&power / odd) };
            (power, odd) = (power / (whole * whole), odd + 2);
        }
        sum
    };
    let mantissa: BigInt = arctangent_of_one_over(5) * 16 - arctangent_of_one_over(239) * 4;
    Dyadic { mantissa, exponent: -(PRECISION + 32) as i32 }
}

/// The tangent of an angle strictly between −90 and 90 degrees, with a relative error below 2^-300.
///
/// The reduction tan(a) = 1 / tan(90° − a) is made in degrees, where the difference is exact, so angles next to
/// 0 and next to 90 degrees lose nothing.
///
/// # Panics
/// When the angle lies outside that range.
#[must_use]
pub fn tan_of_degrees(degrees: &Dyadic) -> Dyadic {
    let rest = &Dyadic::of(90) - &degrees.abs();
    assert!(rest.sign() > 0, "the angle lies strictly between -90 and 90 degrees");
    if degrees.abs() > Dyadic::of(45) {
        let cotangent = tan_of_degrees(&rest);
        let tangent = Dyadic::of(1).divided_by(&cotangent);
        return if degrees.sign() < 0 { -&tangent } else { tangent };
    }
    let angle = (degrees * &pi()).divided_by(&Dyadic::of(180));
    let sine = alternating_series(angle.clone(), &angle, 2);
    sine.divided_by(&alternating_series(Dyadic::of(1), &angle, 1))
}

/// first · (1 − a²/(k(k+1)) + a⁴/(k(k+1)(k+2)(k+3)) − …): the sine from (a, k = 2), the cosine from (1, k = 1).
fn alternating_series(first: Dyadic, angle: &Dyadic, mut k: i32) -> Dyadic {
    let square = angle.squared().shortened();
    let (mut term, mut sum) = (first.clone(), first);
    // Below 45 degrees a term shrinks at least threefold, and the series ends when one no longer reaches the sum.
    while term.sign() != 0 && term.abs() > sum.abs().scaled(-(PRECISION as i32)) {
        let divisor = Dyadic::of(-k * (k + 1));
        term = (&term * &square).divided_by(&divisor).shortened();
        sum = (&sum + &term).shortened();
        k += 2;
    }
    sum
}

/// |measured − exact| / |exact|; infinite when the measured number is not finite, or the exact one is zero and the
/// measured one is not.
#[must_use]
pub fn relative_error(measured: f64, exact: &Dyadic) -> f64 {
    if !measured.is_finite() {
        return f64::INFINITY;
    }
    let difference = (&Dyadic::of(measured) - exact).abs();
    match (difference.sign(), exact.sign()) {
        (0, _) => 0.0,
        (_, 0) => f64::INFINITY,
        _ => difference.divided_by(&exact.abs()).to_f64(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The number's first digits as a decimal fraction, cut off rather than rounded.
    fn digits(number: &Dyadic, count: u32) -> String {
        let scaled = number.mantissa.clone() * BigInt::from(10).pow(count);
        let text = (scaled >> -number.exponent).to_string();
        let whole = text.len() - count as usize;
        format!("{}.{}", &text[..whole], &text[whole..])
    }

    #[test]
    fn transcendentals_have_their_known_digits() {
        assert_eq!(digits(&pi(), 50), "3.14159265358979323846264338327950288419716939937510");
        let root = Dyadic::of(2).square_root();
        assert_eq!(digits(&root, 50), "1.41421356237309504880168872420969807856967187537694");
        let third = &Dyadic::of(1).divided_by(&Dyadic::of(3)) + &Dyadic::of(1);
        assert_eq!(digits(&third, 50), format!("1.{}", "3".repeat(50)));
        let one_degree = &tan_of_degrees(&Dyadic::of(1)) + &Dyadic::of(1);
        assert_eq!(digits(&one_degree, 50), "1.01745506492821758576512889521972782431410158883987");
        assert_eq!(relative_error(1.0, &tan_of_degrees(&Dyadic::of(45))), 0.0);
    }

    /// 2^-300 as an exact number.
    fn tiny() -> Dyadic {
        Dyadic::of(1).scaled(-300)
    }

    proptest! {
        #[test]
        fn floats_survive_the_round_trip(bits: u64, single: f32) {
            let value = f64::from_bits(bits);
            if value.is_finite() {
                prop_assert_eq!(Dyadic::of(value).to_f64(), value);
            }
            if single.is_finite() {
                prop_assert_eq!(Dyadic::of(single).to_f64() as f32, single);
            }
        }

        #[test]
        fn one_operation_then_rounding_is_what_the_processor_does(a: f64, b: f64) {
            let (exact_a, exact_b) = (Dyadic::of(a), Dyadic::of(b));
            prop_assert_eq!((&exact_a + &exact_b).to_f64(), a + b);
            prop_assert_eq!((&exact_a - &exact_b).to_f64(), a - b);
            prop_assert_eq!((&exact_a * &exact_b).to_f64(), a * b);
            prop_assert_eq!(exact_a.abs().square_root().to_f64(), a.abs().sqrt());
            prop_assert_eq!(Some(exact_a.cmp(&exact_b)), a.partial_cmp(&b));
            if b != 0.0 {
                prop_assert_eq!(exact_a.divided_by(&exact_b).to_f64(), a / b);
            }
        }

        #[test]
        fn the_double_angle_holds(degrees in -44.9..44.9f64) {
            let tangent = tan_of_degrees(&Dyadic::of(degrees));
            let one = Dyadic::of(1);
            let double = tangent.scaled(1).divided_by(&(&one - &tangent.squared()));
            let direct = tan_of_degrees(&Dyadic::of(degrees).scaled(1));
            prop_assert!((&double - &direct).abs() <= &direct.abs() * &tiny());
        }
    }
}
