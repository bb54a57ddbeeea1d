use super::hash::halves;
use super::{DIMENSIONS, Draw, PixelKey, Purpose, owen_scrambled};

/// A dimension's polynomial and first direction numbers.
type JoeKuo = (usize, u32, [u32; 6]);

/// Degree, coefficients and first direction numbers of dimensions 2 to 16 (Joe and Kuo 2008, new-joe-kuo-6.21201).
const JOE_KUO: [JoeKuo; DIMENSIONS as usize - 1] = [
    (1, 0, [1, 0, 0, 0, 0, 0]),
    (2, 1, [1, 3, 0, 0, 0, 0]),
    (3, 1, [1, 3, 1, 0, 0, 0]),
    (3, 2, [1, 1, 1, 0, 0, 0]),
    (4, 1, [1, 1, 3, 3, 0, 0]),
    (4, 4, [1, 3, 5, 13, 0, 0]),
    (5, 2, [1, 1, 5, 5, 17, 0]),
    (5, 4, [1, 1, 5, 5, 5, 0]),
    (5, 7, [1, 1, 7, 11, 19, 0]),
    (5, 11, [1, 1, 5, 1, 1, 0]),
    (5, 13, [1, 1, 1, 3, 11, 0]),
    (5, 14, [1, 3, 5, 5, 31, 0]),
    (6, 1, [1, 3, 3, 9, 7, 49]),
    (6, 13, [1, 1, 1, 15, 21, 21]),
    (6, 16, [1, 3, 1, 13, 27, 49]),
];

/// For every dimension the fraction, in reversed bits, that each binary digit of a point's number adds.
const REVERSED: [[u32; 32]; DIMENSIONS as usize] = {
    let mut table = [[0; 32]; DIMENSIONS as usize];
    let mut dimension = 0;
    while dimension < DIMENSIONS as usize {
        table[dimension] = reversed_directions(dimension);
        dimension += 1;
    }
    table
};

/// The recurrence of the direction numbers (Bratley and Fox 1988).
const fn reversed_directions(dimension: usize) -> [u32; 32] {
    let mut v = [0_u32; 32];
    let mut i = 0;
    while i < 32 {
        v[i] = if dimension == 0 {
            1 << (31 - i)
        } else {
            let (degree, coefficients, first) = JOE_KUO[dimension - 1];
            if i < degree {
                first[i] << (31 - i)
            } else {
                let mut next = v[i - degree] ^ (v[i - degree] >> degree);
                let mut k = 1;
                while k < degree {
                    if coefficients >> (degree - 1 - k) & 1 == 1 {
                        next ^= v[i - k];
                    }
                    k += 1;
                }
                next
            }
        };
        i += 1;
    }
    let mut i = 0;
    while i < 32 {
        v[i] = v[i].reverse_bits();
        i += 1;
    }
    v
}

// ANCHOR: sobol_bits
/// A coordinate of a point of the Sobol sequence, as a fraction of 32 bits in reverse; dimensions count from 0.
#[inline(always)]
pub fn sobol_bits(number: u32, dimension: u32) -> u32 {
    let directions = &REVERSED[dimension as usize];
    let (mut left, mut fraction) = (number, 0);
    while left != 0 {
        fraction ^= directions[left.trailing_zeros() as usize];
        left &= left - 1;
    }
    fraction
}
// ANCHOR_END: sobol_bits

/// A point of the Sobol sequence, scrambled for every pixel by itself.
///
/// The first 2ᵏ samples of a pixel are as even as 2ᵏ points of the sequence can be, and so is every later block of 2ᵏ.
/// On each leg of a light's way after the first, all purposes together take the points of such a block in another order,
/// so that the same dimensions can serve again: within a leg purposes stay even together, between legs they are
/// independent (padding).
#[derive(Clone, Copy, Debug)]
pub struct Sobol {
    dimension: u32,
    reversed: [u32; 2],
}

impl Sobol {
    /// A sample's numbers for a purpose on a leg of the light's way.
    #[inline(always)]
    pub fn new(sample: u32, leg: u32, purpose: Purpose) -> Self {
        let dimension = purpose.dimension(leg);
        let number = if leg == 0 { sample } else { in_another_order(sample, leg) };
        let second = dimension % DIMENSIONS + purpose.numbers() - 1;
        Self { dimension, reversed: [dimension % DIMENSIONS, second].map(|within| sobol_bits(number, within)) }
    }
}

/// The number of the point that a sample takes on a later leg; samples of a block of 2ᵏ stay within a block.
#[inline(always)]
fn in_another_order(sample: u32, leg: u32) -> u32 {
    let [seed, _] = halves(super::hash::mixed(u64::from(leg)));
    owen_scrambled(sample.reverse_bits(), seed).reverse_bits()
}

impl Draw for Sobol {
    #[inline(always)]
    fn one(self, pixel: PixelKey) -> u32 {
        let [seed, _] = halves(pixel.bits(self.dimension, 0));
        owen_scrambled(self.reversed[0], seed).reverse_bits()
    }

    #[inline(always)]
    fn two(self, pixel: PixelKey) -> [u32; 2] {
        let seeds = halves(pixel.bits(self.dimension, 0));
        [0, 1].map(|axis| owen_scrambled(self.reversed[axis], seeds[axis]).reverse_bits())
    }
}
