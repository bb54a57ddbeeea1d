//! Exact arithmetic on dyadic numbers: whole numbers times powers of two.
//!
//! Every finite f32 and f64 is dyadic, and so is every sum and product of dyadics; an oracle that
//! only adds, multiplies and asks for signs therefore never rounds. Quotients, roots and tangents
//! are not dyadic: they are rounded, with a relative error below 2^-300.

use num_bigint::{BigInt, Sign};
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// The bits that a quotient or a square root keeps.
pub const PRECISION: i64 = 320;

/// u, the rounding unit of f32: half the spacing of numbers just above 1.
pub const UNIT_ROUNDOFF_F32: f64 = 1.0 / (1u64 << 24) as f64;

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
    /// When the value is not finite: infinity has no exact value to check by.
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
    #[must_use]
    pub fn shortened(&self) -> Self {
        let surplus = (self.mantissa.bits() as i64 - PRECISION).max(0);
        Self { mantissa: &self.mantissa >> surplus, exponent: self.exponent + surplus as i32 }
    }

    /// The mantissa this number has at a lower exponent.
    fn in_units_of(&self, exponent: i32) -> BigInt {
        &self.mantissa << (self.exponent - exponent)
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
        Dyadic { mantissa: self.in_units_of(exponent) + other.in_units_of(exponent), exponent }
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

/// |measured − exact| / |exact|; infinite when the measured number is not finite, or the exact one
/// is zero and the measured one is not.
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
    }
}
