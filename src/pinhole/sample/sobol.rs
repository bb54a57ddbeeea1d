use super::hash::halves;
use super::{DIMENSIONS, Draw, PixelKey, Purpose, SampleIndex, owen_scrambled};

/// The primitive polynomial of a dimension (degree and coefficients), and its initial direction numbers.
type JoeKuo = (usize, u32, [u32; 6]);

/// Dimensions 2 to 16 of Joe and Kuo (2008, new-joe-kuo-6.21201).
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

/// The generator matrices with reversed bits: for each dimension, the fraction that each binary digit of a point's
/// index contributes.
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
/// A coordinate of a point of the Sobol sequence, as a 32-bit fraction with reversed bits; dimensions count from 0.
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

/// The Sobol sampler: a point of the Sobol sequence, Owen-scrambled independently for every pixel.
///
/// The first 2ᵏ samples of a pixel are as well distributed as 2ᵏ points of the sequence can be, and so is every later
/// block of 2ᵏ.
/// At each bounce after the first, all purposes together visit the points of such a block in a shuffled order, so that
/// the same dimensions can be used again: within a bounce purposes remain jointly stratified, and between bounces they
/// are independent (padding).
#[derive(Clone, Copy, Debug)]
pub struct Sobol {
    dimension: u32,
    reversed: [u32; 2],
}

impl Sobol {
    /// A sample's numbers for a purpose at a bounce.
    #[inline(always)]
    pub fn new(sample: u32, depth: u32, purpose: Purpose) -> Self {
        let dimension = purpose.dimension(depth);
        let number = if depth == 0 { sample } else { shuffled(sample, depth) };
        let second = dimension % DIMENSIONS + purpose.numbers() - 1;
        Self { dimension, reversed: [dimension % DIMENSIONS, second].map(|within| sobol_bits(number, within)) }
    }
}

/// The index of the point that a sample uses at a later bounce; samples of a block of 2ᵏ stay within a block.
#[inline(always)]
fn shuffled(sample: u32, depth: u32) -> u32 {
    let [seed, _] = halves(super::hash::mixed(u64::from(depth)));
    owen_scrambled(sample.reverse_bits(), seed).reverse_bits()
}

impl Draw for Sobol {
    #[inline(always)]
    fn of(sample: SampleIndex, purpose: Purpose) -> Self {
        Self::new(sample.number, sample.depth, purpose)
    }

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

#[cfg(test)]
mod tests {
    use super::*;

    /// Pairs of dimensions that one purpose draws together.
    fn pairs() -> Vec<[u32; 2]> {
        let two = |purpose: &Purpose| purpose.numbers() == 2;
        Purpose::ALL.into_iter().filter(two).map(|purpose| [0, 1].map(|n| purpose.dimension(0) + n)).collect()
    }

    /// The smallest t for which 2ᵐ points are a (t, m, 2)-net: each box of area 2ᵗ⁻ᵐ with sides of powers of two holds
    /// 2ᵗ.
    fn quality(points: &[[u32; 2]]) -> u32 {
        let m = points.len().trailing_zeros();
        let is_net = |t: u32| {
            (0..=m - t).all(|across| {
                let down = m - t - across;
                let mut count = vec![0_u32; 1 << (m - t)];
                for point in points {
                    let cell = |fraction: u32, digits: u32| (u64::from(fraction) >> (32 - digits)) as usize;
                    count[cell(point[0], across) << down | cell(point[1], down)] += 1;
                }
                count.iter().all(|&count| count == 1 << t)
            })
        };
        (0..=m).find(|&t| is_net(t)).unwrap_or(m)
    }

    fn degree(dimension: u32) -> u32 {
        if dimension == 0 { 0 } else { JOE_KUO[dimension as usize - 1].0 as u32 }
    }

    #[test]
    fn first_points_are_those_of_the_literature() {
        // Points 0 to 7 of the first three dimensions, in eighths, in the order of their indices (not of Gray codes).
        let known = [[0, 4, 2, 6, 1, 5, 3, 7], [0, 4, 6, 2, 5, 1, 3, 7], [0, 4, 6, 2, 3, 7, 5, 1]];
        for (dimension, eighths) in (0..).zip(known) {
            let own: Vec<u32> = (0..8).map(|n| sobol_bits(n, dimension).reverse_bits() >> 29).collect();
            assert_eq!(own, eighths, "dimension {dimension}");
        }
    }

    /// Every block of 2ᵐ samples has one in each interval of length 2⁻ᵐ on each axis; the two numbers for the pixel,
    /// one in every elementary box of area 2⁻ᵐ; other pairs, 2ᵗ in every box of area 2ᵗ⁻ᵐ, with the t that theory
    /// allows (Niederreiter 1987: the sum of the degrees minus 1 each).
    #[test]
    fn nets() {
        let (mut tried, mut worst) = (0, Vec::new());
        for purpose in Purpose::ALL.into_iter().filter(|purpose| purpose.numbers() == 2) {
            let [first, second] = [0, 1].map(|n| degree(purpose.dimension(0) + n));
            let allowed = first.saturating_sub(1) + second.saturating_sub(1);
            let mut largest = 0;
            for m in 0..=10_u32 {
                for (seed, block, depth) in [(0, 0, 0), (1, 0, 0), (2, 1, 0), (3, 5, 0), (4, 0, 1), (5, 3, 2)] {
                    let pixel = PixelKey::new(seed, [7, 11]);
                    let numbers = block << m..(block + 1) << m;
                    let points: Vec<_> = numbers.map(|n| Sobol::new(n, depth, purpose).two(pixel)).collect();
                    for axis in 0..2 {
                        let own: Vec<[u32; 2]> = points.iter().map(|point| [point[axis], 0]).collect();
                        let mut cells: Vec<u64> = own.iter().map(|p| u64::from(p[0]) >> (32 - m)).collect();
                        cells.sort_unstable();
                        assert!(cells.iter().copied().eq(0..1 << m), "{purpose:?}, axis {axis}, 2^{m} points");
                    }
                    let t = quality(&points);
                    assert!(
                        t <= allowed,
                        "{purpose:?}, 2^{m} points, depth {depth}: t = {t}, but {allowed} is allowed"
                    );
                    (largest, tried) = (largest.max(t), tried + 1);
                }
            }
            worst.push(format!("{purpose:?} {largest} of {allowed}"));
        }
        assert!(worst[0].ends_with("0 of 0"), "the pixel's numbers are a (0, m, 2)-net");
        eprintln!("nets: {tried} blocks of 2^0 to 2^10 samples; largest t: {}", worst.join(", "));
    }

    /// Unscrambled points equal those of the crate sobol_burley, and its scrambled pairs have the same t as pinhole's.
    #[test]
    fn agrees_with_sobol_burley() {
        let (mut points, mut compared) = (0, 0);
        for dimension in 0..DIMENSIONS {
            for number in 0..1_u32 << 16 {
                let theirs = sobol_burley::parts::sobol_rev(number.reverse_bits(), dimension);
                assert_eq!(sobol_bits(number, dimension), theirs, "{number} in dimension {dimension}");
                points += 1;
            }
        }
        for pair in pairs() {
            for m in 0..=10_u32 {
                let theirs = |n: u32, d: u32| {
                    // Exact: 24 bits of an f32 from 0 to 1.
                    ((f64::from(sobol_burley::sample(n, d, 9)) * f64::from(1 << 24)) as u32) << 8
                };
                let burley: Vec<[u32; 2]> = (0..1 << m).map(|n| pair.map(|d| theirs(n, d))).collect();
                let pixel = PixelKey::new(9, [0, 0]);
                let purpose = Purpose::ALL.into_iter().find(|purpose| purpose.dimension(0) == pair[0]);
                let purpose = purpose.expect("a purpose");
                let own: Vec<[u32; 2]> = (0..1 << m).map(|n| Sobol::new(n, 0, purpose).two(pixel)).collect();
                assert_eq!(quality(&own), quality(&burley), "dimensions {pair:?}, 2^{m} points");
                compared += 1;
            }
        }
        eprintln!("sobol_burley: {points} coordinates equal to all 32 digits, {compared} nets of equal t");
    }
}
