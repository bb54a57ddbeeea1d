//! Sums and products of f64 without any error: for the few rays and shapes that rounding would misjudge.
//!
//! A number is held as a sum of f64 of falling size that share no binary digit (Shewchuk, *Adaptive precision
//! floating-point arithmetic and fast robust geometric predicates*, 1997): so the sign of the largest is its sign.
//! No fused multiply-add is used, so every machine gives the same bits.
//! Right as long as every digit of every product is at least 2⁻¹⁰⁷⁴, the last that f64 can hold.

use glam::DVec3;

/// Parts that a sum has room for; drawn together it needs no more than 41, for f64 spans 2098 binary digits.
const ROOM: usize = 64;

/// A sum of f64, exactly.
#[derive(Clone, Copy, Debug)]
pub struct ExactSum {
    /// Of rising size, none 0, none sharing a digit with another.
    parts: [f64; ROOM],
    length: usize,
}

/// a + b without any error: the rounded sum and what it lost (Knuth, *The Art of Computer Programming* vol. 2, 4.2.2).
#[inline(always)]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_seen = sum - a;
    (sum, (a - (sum - b_seen)) + (b - b_seen))
}

/// a · b without any error (Dekker 1971), each factor cut into halves of 26 bits.
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

    /// −1, 0 or 1.
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

    /// Appends a part larger than all; a 0 is none.
    fn push(&mut self, part: f64) {
        self.parts[self.length] = part;
        self.length += usize::from(part != 0.0);
    }

    /// Adds one f64 (Shewchuk's Grow-Expansion, zeros left out).
    fn add(&mut self, term: f64) {
        if self.length == ROOM - 1 {
            self.draw_together();
        }
        let (terms, mut carried) = (self.length, term);
        self.length = 0;
        for term in 0..terms {
            let (sum, lost) = two_sum(carried, self.parts[term]);
            self.push(lost);
            carried = sum;
        }
        self.push(carried);
    }

    /// The same number in as few parts as can be (Shewchuk's Compress).
    fn draw_together(&mut self) {
        let (mut larger, mut carried) = ([0.0; ROOM], 0.0);
        let mut count = 0;
        for &part in self.terms().iter().rev() {
            let (sum, lost) = two_sum(carried, part);
            carried = sum;
            if lost != 0.0 {
                (larger[count], carried) = (sum, lost);
                count += 1;
            }
        }
        self.length = 0;
        for &part in larger[..count].iter().rev() {
            let (sum, lost) = two_sum(part, carried);
            self.push(lost);
            carried = sum;
        }
        self.push(carried);
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
    fn what_a_sum_and_a_product_lose_is_in_the_second_half() {
        assert_eq!(two_sum(1e16, 1.0), (1e16, 1.0));
        let x = 1.0 + 2.0 * f64::EPSILON;
        assert_eq!(two_product(x, x).1, 4.0 * f64::EPSILON * f64::EPSILON);
    }

    #[test]
    fn nothing_is_lost_however_far_apart() {
        let mut sum = ExactSum::ZERO;
        let terms: Vec<f64> = (-900..900).step_by(7).map(|power| libm::ldexp(1.0, power)).collect();
        terms.iter().for_each(|&term| sum.add(term));
        assert_eq!(sum.sign(), 1);
        terms.iter().rev().for_each(|&term| sum.add(-term));
        assert_eq!((sum.sign(), sum.length), (0, 0), "all that went in came out, over {} terms", terms.len());
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
