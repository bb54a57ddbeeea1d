//! Exact sums and products of f64, for the few rays and shapes that rounding would misclassify.
//!
//! A number is represented as a sum of f64 of decreasing magnitude that do not overlap in any binary digit (Shewchuk,
//! *Adaptive precision floating-point arithmetic and fast robust geometric predicates*, 1997), so the sign of the
//! largest is the sign of the number.
//! No fused multiply-add is used, so every machine gives the same bits.
//! Exact as long as every digit of every product is at least 2⁻¹⁰⁷⁴, the smallest that f64 can represent.

use glam::DVec3;

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

    /// The difference of both.
    pub fn less(mut self, other: &Self) -> Self {
        other.terms().iter().for_each(|&part| self.add(-part));
        self
    }

    /// The product of both.
    pub fn by(&self, other: &Self) -> Self {
        let mut product = Self::ZERO;
        for &a in self.terms() {
            for &b in other.terms() {
                let (high, low) = two_product(a, b);
                product.add(low);
                product.add(high);
            }
        }
        product
    }

    /// The product with one f64.
    pub fn times(&self, factor: f64) -> Self {
        let mut one = Self::ZERO;
        one.push(factor);
        self.by(&one)
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
    [0, 1, 2].map(|axis| ExactSum::difference(a[axis], b[axis]))
}

/// a × b.
pub fn exact_cross(a: &ExactVector, b: &ExactVector) -> ExactVector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i].by(&b[j]).less(&a[j].by(&b[i])))
}

/// a · b.
pub fn exact_dot(a: &ExactVector, b: &ExactVector) -> ExactSum {
    a[0].by(&b[0]).plus(&a[1].by(&b[1])).plus(&a[2].by(&b[2]))
}

#[cfg(test)]
mod tests {
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
        let by = |a: f64, b: f64| ExactSum::difference(x, -a).by(&ExactSum::difference(x, -b));
        let left = by(0.0, 0.0).less(&by(d, -d));
        assert_eq!((left.sign(), left.rounded()), (1, d * d));
    }
}
