//! Numbers with their error bounds, and sums without error.
//!
//! Arithmetic for shapes whose intersection is written once and computed twice: in f64 with a running error bound, and
//! in double-double where that bound leaves a sign uncertain.
//!
//! A running error bound adds up, operation by operation, how far rounding can have moved a number (Wilkinson,
//! *Rounding Errors in Algebraic Processes*, 1963; PBRT's `Interval` serves the same purpose).

use super::double_double::{DoubleDouble, add, multiply, negated};
use glam::DVec3;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::each::Each;

/// 2⁻⁵³, the unit roundoff of f64.
const EPSILON: f64 = 1.0 / (1_u64 << 53) as f64;
/// More than the rounding of an error bound itself can take away.
const GROWN: f64 = 1.0 + 16.0 * EPSILON;
/// Half of u: the largest relative error of a t that counts as certain.
const SMALL: f64 = 1.0 / (1_u64 << 25) as f64;

/// A number that an intersection computes with.
pub trait Arithmetic:
    Copy
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Whether there is nothing more precise to turn to, so that every sign is given.
    const IS_LAST: bool;

    /// The square root; of a number below 0 that of 0.
    fn root(self) -> Self;

    /// −1, 0 or 1; none where that is uncertain.
    fn sign(self) -> Option<i32>;

    /// The number, rounded to f64.
    fn value(self) -> f64;

    /// An upper bound of what rounding can have changed, if that is known.
    fn error(self) -> f64;

    /// The magnitude.
    #[inline(always)]
    fn abs(self) -> Self {
        if self.value() < 0.0 { -self } else { self }
    }

    /// Whether it is surely above 0.
    #[inline(always)]
    fn is_surely_positive(self) -> bool {
        self.sign() == Some(1)
    }

    /// The value of a distance whose relative error is at most 2⁻²⁵; none where it may be larger.
    #[inline(always)]
    fn certain(self) -> Option<f64> {
        (self.error() <= SMALL * self.value().abs()).then_some(self.value())
    }
}

/// A dot product.
#[inline(always)]
pub fn dot_of<N: Arithmetic>(a: [N; 3], b: [N; 3]) -> N {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// An f64 with a running error bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounded {
    value: f64,
    error: f64,
}

impl Bounded {
    #[inline(always)]
    fn rounded(value: f64, error: f64) -> Self {
        Self { value, error: (error + EPSILON * value.abs()) * GROWN }
    }
}

impl From<f64> for Bounded {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self { value, error: 0.0 }
    }
}

impl Add for Bounded {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::rounded(self.value + other.value, self.error + other.error)
    }
}

impl Sub for Bounded {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::rounded(self.value - other.value, self.error + other.error)
    }
}

impl Mul for Bounded {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let error = self.value.abs() * other.error + self.error * (other.value.abs() + other.error);
        Self::rounded(self.value * other.value, error)
    }
}

impl Div for Bounded {
    type Output = Self;
    /// |a/b − a′/b′| ≤ (e_a + |a/b| e_b) / (|b| − e_b); infinite where b may be 0.
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let (quotient, min) = (self.value / other.value, other.value.abs() - other.error);
        let error = (self.error + quotient.abs() * GROWN * other.error) / min * GROWN;
        Self::rounded(quotient, if min > 0.0 { error } else { f64::INFINITY })
    }
}

impl Neg for Bounded {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl Arithmetic for Bounded {
    const IS_LAST: bool = false;

    /// |√a − √a′| ≤ e / √a, since √a′ is not below 0.
    #[inline(always)]
    fn root(self) -> Self {
        let root = self.value.max(0.0).sqrt();
        let error = if self.error == 0.0 { 0.0 } else { self.error / root * GROWN };
        Self::rounded(root, error)
    }

    #[inline(always)]
    fn sign(self) -> Option<i32> {
        let Self { value, error } = self;
        if value > error {
            Some(1)
        } else if value < -error {
            Some(-1)
        } else if value == 0.0 && error == 0.0 {
            Some(0)
        } else {
            None
        }
    }

    #[inline(always)]
    fn value(self) -> f64 {
        self.value
    }

    #[inline(always)]
    fn error(self) -> f64 {
        self.error
    }
}

/// A double-double, with about 106 bits, whose signs are taken as they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Precise(DoubleDouble);

impl From<f64> for Precise {
    fn from(value: f64) -> Self {
        Self((value, 0.0))
    }
}

impl Add for Precise {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(add(self.0, other.0))
    }
}

impl Sub for Precise {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(add(self.0, negated(other.0)))
    }
}

impl Mul for Precise {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(multiply(self.0, other.0))
    }
}

impl Div for Precise {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.0.0 / other.0.0;
        let rest = self - Self::from(first) * other;
        let second = rest.0.0 / other.0.0;
        let rest = rest - Self::from(second) * other;
        Self(two_sum(first, second)) + Self::from(rest.0.0 / other.0.0)
    }
}

impl Neg for Precise {
    type Output = Self;
    fn neg(self) -> Self {
        Self(negated(self.0))
    }
}

impl Arithmetic for Precise {
    const IS_LAST: bool = true;

    fn root(self) -> Self {
        let root = self.0.0.max(0.0).sqrt();
        if root == 0.0 {
            return Self::from(0.0);
        }
        let rest = self - Self(two_product(root, root));
        Self(two_sum(root, rest.0.0 / (2.0 * root)))
    }

    fn sign(self) -> Option<i32> {
        Some(i32::from(self.0.0 > 0.0) - i32::from(self.0.0 < 0.0))
    }

    fn value(self) -> f64 {
        self.0.0
    }

    fn error(self) -> f64 {
        0.0
    }
}

/// A t with an interval that contains its exact value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    /// The value as computed.
    pub t: f64,
    /// No more than the exact value.
    pub min: f64,
    /// No less than it.
    pub max: f64,
}

impl Interval {
    #[inline(always)]
    pub fn new(t: f64, error: f64) -> Self {
        Self { t, min: t - error, max: t + error }
    }

    /// The larger of each number; a NaN is never taken over, for comparisons with it are false.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        let larger = |a: f64, b: f64| if b > a { b } else { a };
        Self { t: larger(self.t, other.t), min: larger(self.min, other.min), max: larger(self.max, other.max) }
    }

    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        let smaller = |a: f64, b: f64| if b < a { b } else { a };
        Self { t: smaller(self.t, other.t), min: smaller(self.min, other.min), max: smaller(self.max, other.max) }
    }
}

// Exact sums and products of f64, for the few rays and shapes that rounding would misclassify.
//
// A number is represented as a sum of f64 of decreasing magnitude that do not overlap in any binary digit (Shewchuk,
// *Adaptive precision floating-point arithmetic and fast robust geometric predicates*, 1997), so the sign of the
// largest is the sign of the number.
// No fused multiply-add is used, so every machine gives the same bits.
// Exact as long as every digit of every product is at least 2⁻¹⁰⁷⁴, the smallest that f64 can represent.

/// The capacity of a sum; compressed, it needs at most 41 parts, since f64 spans 2098 binary digits.
const ROOM: usize = 64;

/// An exact sum of f64.
#[derive(Clone, Copy, Debug)]
pub struct ExactSum {
    /// In increasing order of magnitude, nonzero and nonoverlapping.
    parts: [f64; ROOM],
    length: usize,
}

/// a + b without error: the rounded sum and its rounding error (Knuth, *The Art of Computer Programming* vol. 2,
/// 4.2.2).
#[inline(always)]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_seen = sum - a;
    (sum, (a - (sum - b_seen)) + (b - b_seen))
}

/// a · b without error (Dekker 1971), with each factor split into halves of 26 bits.
#[inline(always)]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    const CUT: f64 = 134_217_729.0;
    let halves = |x: f64| {
        let high = x * CUT - (x * CUT - x);
        (high, x - high)
    };
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (halves(a), halves(b));
    (product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low)
}

impl ExactSum {
    /// 0.
    pub const ZERO: Self = Self { parts: [0.0; ROOM], length: 0 };

    /// a − b.
    pub fn difference(a: f64, b: f64) -> Self {
        let (high, low) = two_sum(a, -b);
        let mut sum = Self::ZERO;
        sum.push(low);
        sum.push(high);
        sum
    }

    /// The sign: −1, 0 or 1.
    pub fn sign(&self) -> i32 {
        let largest = self.terms().last().copied().unwrap_or(0.0);
        i32::from(largest > 0.0) - i32::from(largest < 0.0)
    }

    /// The number as an f64, to within two roundings.
    pub fn rounded(&self) -> f64 {
        self.terms().iter().sum()
    }

    /// The sum of both.
    pub fn plus(mut self, other: &Self) -> Self {
        other.terms().iter().for_each(|&part| self.add(part));
        self
    }

    /// Adds the product of two others; with the sign −1 takes it away.
    pub fn add_product(&mut self, a: &Self, b: &Self, sign: f64) {
        for &a in a.terms() {
            for &b in b.terms() {
                let (high, low) = two_product(sign * a, b);
                self.add(low);
                self.add(high);
            }
        }
    }

    fn terms(&self) -> &[f64] {
        &self.parts[..self.length]
    }

    /// Appends a part larger than all others, unless it is 0.
    fn push(&mut self, part: f64) {
        self.parts[self.length] = part;
        self.length += usize::from(part != 0.0);
    }

    /// Adds one f64 (Shewchuk's Grow-Expansion with zero elimination).
    fn add(&mut self, term: f64) {
        if self.length == ROOM - 1 {
            self.compress();
        }
        let (terms, mut rest) = (self.length, term);
        self.length = 0;
        for term in 0..terms {
            let (sum, lost) = two_sum(rest, self.parts[term]);
            self.push(lost);
            rest = sum;
        }
        self.push(rest);
    }

    /// The same number in the fewest parts (Shewchuk's Compress).
    fn compress(&mut self) {
        let (mut larger, mut rest) = ([0.0; ROOM], 0.0);
        let mut count = 0;
        for &part in self.terms().iter().rev() {
            let (sum, lost) = two_sum(rest, part);
            rest = sum;
            if lost != 0.0 {
                (larger[count], rest) = (sum, lost);
                count += 1;
            }
        }
        self.length = 0;
        for &part in larger[..count].iter().rev() {
            let (sum, lost) = two_sum(part, rest);
            self.push(lost);
            rest = sum;
        }
        self.push(rest);
    }
}

/// Three exact numbers.
pub type ExactVector = [ExactSum; 3];

/// a − b.
pub fn exact_difference(a: DVec3, b: DVec3) -> ExactVector {
    [0, 1, 2].each(|axis| ExactSum::difference(a[axis], b[axis]))
}

/// a × b.
pub fn exact_cross(a: &ExactVector, b: &ExactVector) -> ExactVector {
    let mut cross = [ExactSum::ZERO; 3];
    for (part, (i, j)) in cross.iter_mut().zip([(1, 2), (2, 0), (0, 1)]) {
        part.add_product(&a[i], &b[j], 1.0);
        part.add_product(&a[j], &b[i], -1.0);
    }
    cross
}

/// a · b.
pub fn exact_dot(a: &ExactVector, b: &ExactVector) -> ExactSum {
    let mut sum = ExactSum::ZERO;
    a.iter().zip(b).for_each(|(a, b)| sum.add_product(a, b, 1.0));
    sum
}

#[cfg(test)]
mod arithmetic_tests {
    use super::*;
    use crate::measure::draws::Draws;

    /// A computation that cancels, in f64 with its bound and in double-double, which is exact beside it.
    #[test]
    fn errors_are_within_their_bounds_and_bounds_are_not_idle() {
        const TRIED: u32 = 20_000;
        let mut largest = 0.0_f64;
        for index in 0..u64::from(TRIED) {
            let mut draws = Draws::new(2801, index);
            let numbers = [(); 4].map(|()| draws.between(-2.0, 2.0));
            fn chain<N: Arithmetic>(numbers: [f64; 4]) -> N {
                let [a, b, c, d] = numbers.each(N::from);
                let inner = a * b - c * d + (a * a + d * d).root();
                (inner * inner - a) / (b * b + N::from(0.01))
            }
            let (found, exact) = (chain::<Bounded>(numbers), chain::<Precise>(numbers));
            let off = (Precise::from(found.value()) - exact).value().abs();
            assert!(off <= found.error(), "{numbers:?}: {off:e} beyond {:e}", found.error());
            largest = largest.max(off / found.error());
        }
        eprintln!("running error bounds: {TRIED} chains, at most {largest:.2} of the bound");
        assert!(largest > 0.05);
    }

    /// A sign is given where the error leaves no other, and a distance where it is known to half of u.
    #[test]
    fn what_an_error_leaves_open_is_not_said() {
        let of = |value: f64, error: f64| Bounded { value, error };
        for size in [1e-6, 1.0, 1e6] {
            for (error, sign) in [(0.0, Some(1)), (0.9, Some(1)), (1.1, None)] {
                assert_eq!(of(size, error * size).sign(), sign);
                assert_eq!(of(-size, error * size).sign(), sign.map(|sign| -sign));
            }
            assert_eq!(of(0.0, size).sign(), None);
            for value in [size, -size] {
                assert_eq!(of(value, 0.9 * size / 33_554_432.0).certain(), Some(value));
                assert_eq!(of(value, 1.1 * size / 33_554_432.0).certain(), None);
            }
        }
        assert_eq!(of(0.0, 0.0).sign(), Some(0));
    }
}

#[cfg(test)]
mod exact_sum_tests {
    use super::*;

    #[test]
    fn the_rounding_error_of_a_sum_or_product_is_the_second_half() {
        assert_eq!(two_sum(1e16, 1.0), (1e16, 1.0));
        let x = 1.0 + 2.0 * f64::EPSILON;
        assert_eq!(two_product(x, x).1, 4.0 * f64::EPSILON * f64::EPSILON);
    }

    #[test]
    fn nothing_is_lost_at_any_ratio_of_magnitudes() {
        let mut sum = ExactSum::ZERO;
        let terms: Vec<f64> = (-900..900).step_by(7).map(|power| libm::ldexp(1.0, power)).collect();
        terms.iter().for_each(|&term| sum.add(term));
        assert_eq!(sum.sign(), 1);
        terms.iter().rev().for_each(|&term| sum.add(-term));
        assert_eq!((sum.sign(), sum.length), (0, 0), "everything cancels, over {} terms", terms.len());
    }

    #[test]
    fn a_product_of_neighbours_differs_from_the_square_by_one_digit() {
        // (x + d)(x − d) = x² − d².
        let (x, d) = (1.0 + f64::EPSILON, libm::ldexp(1.0, -80));
        let mut left = ExactSum::ZERO;
        left.add_product(&ExactSum::difference(x, 0.0), &ExactSum::difference(x, 0.0), 1.0);
        left.add_product(&ExactSum::difference(x, -d), &ExactSum::difference(x, d), -1.0);
        assert_eq!((left.sign(), left.rounded()), (1, d * d));
    }
}
