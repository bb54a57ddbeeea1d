//! What an oracle asks of a number, so that each of its formulas is written once and worked out in two ways: exactly, or
//! enclosed, which is a hundred times as fast and may answer that it cannot tell.

use super::exact::Dyadic;
use super::exact_angle::tan_of_degrees;

/// A number that an oracle reckons with; what it answers is right or not given at all.
pub trait Number: Clone {
    /// The value of an f64, exactly.
    fn of(value: f64) -> Self;
    /// The tangent of half an angle strictly between 0 and 180 degrees.
    fn tan_of_half(full_degrees: f64) -> Self;
    /// The sum.
    fn plus(&self, other: &Self) -> Self;
    /// The difference.
    fn less(&self, other: &Self) -> Self;
    /// The product.
    fn by(&self, other: &Self) -> Self;
    /// The quotient; the divisor is not 0.
    fn over(&self, divisor: &Self) -> Self;
    /// The square root; the number is not below 0.
    fn root(&self) -> Self;
    /// −1, 0 or 1; nothing where that cannot be told.
    fn sign(&self) -> Option<i32>;
    /// The nearest f64; nothing where that cannot be told.
    fn rounded(&self) -> Option<f64>;
    /// An f64 within 2⁻²⁰ of the number, relative to it: enough for the size of an error.
    fn about(&self) -> Option<f64>;
}

/// Exactly; quotients, roots and tangents to 300 bits.
impl Number for Dyadic {
    fn of(value: f64) -> Self {
        Self::of(value)
    }

    fn tan_of_half(full_degrees: f64) -> Self {
        tan_of_degrees(&Self::of(full_degrees).scaled(-1))
    }

    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn less(&self, other: &Self) -> Self {
        self - other
    }

    fn by(&self, other: &Self) -> Self {
        self * other
    }

    fn over(&self, divisor: &Self) -> Self {
        self.divided_by(divisor)
    }

    fn root(&self) -> Self {
        self.square_root()
    }

    fn sign(&self) -> Option<i32> {
        Some(Self::sign(self))
    }

    fn rounded(&self) -> Option<f64> {
        Some(self.to_f64())
    }

    fn about(&self) -> Option<f64> {
        Some(self.to_f64())
    }
}
