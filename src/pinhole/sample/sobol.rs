use super::hash::halves;
use super::{Draw, PixelKey, Purpose, SampleIndex, owen_scrambled};

use crate::each::Each;

/// The primitive polynomial of a dimension (degree and coefficients), and its initial direction numbers.
type JoeKuo = (usize, u32, [u32; 3]);

/// The dimensions that purposes draw together, at most.
const TOGETHER: usize = 5;

/// Dimensions 2 to 5 of Joe and Kuo (2008, new-joe-kuo-6.21201).
const JOE_KUO: [JoeKuo; TOGETHER - 1] = [(1, 0, [1, 0, 0]), (2, 1, [1, 3, 0]), (3, 1, [1, 3, 1]), (3, 2, [1, 1, 1])];

/// The generator matrices with reversed bits: for each dimension, the fraction that each binary digit of a point's
/// index contributes.
const REVERSED: [[u32; 32]; TOGETHER] = {
    let mut table = [[0; 32]; TOGETHER];
    let mut dimension = 0;
    while dimension < TOGETHER {
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
/// Purposes whose numbers belong together are dimensions of one point: the pixel, the lens and the time; a light and the
/// point on it; a direction, the lobe and the distance. Each such set begins with the first two dimensions, the only ones
/// whose points are a (0, m, 2)-net, and visits the points of a block in a shuffled order of its own, so that sets and bounces meet
/// at random (padding, as in Burley 2020).
#[derive(Clone, Copy, Debug)]
pub struct Sobol {
    dimension: u32,
    reversed: [u32; 2],
}

/// The set of purposes that a purpose belongs to, and its first dimension there.
const fn place_of(purpose: Purpose) -> (u32, u32) {
    match purpose {
        Purpose::Pixel => (0, 0),
        Purpose::Lens => (0, 2),
        Purpose::Time => (0, 4),
        Purpose::LightPoint => (1, 0),
        Purpose::LightChoice => (1, 2),
        Purpose::Direction => (2, 0),
        Purpose::MaterialChoice => (2, 2),
        Purpose::EnvironmentPoint => (3, 0),
        Purpose::Roulette => (4, 0),
        Purpose::DeltaLightChoice => (5, 0),
        Purpose::Wavelength => (5, 1),
        Purpose::Distance => (2, 3),
    }
}

impl Sobol {
    /// A sample's numbers for a purpose at a bounce.
    #[inline(always)]
    pub fn new(sample: u32, depth: u32, purpose: Purpose) -> Self {
        let (set, first) = place_of(purpose);
        let number = if set == 0 && depth == 0 { sample } else { shuffled(sample, depth * SETS + set) };
        let second = first + purpose.numbers() - 1;
        let dimension = purpose.dimension(depth);
        Self { dimension, reversed: [first, second].each(|within| sobol_bits(number, within)) }
    }
}

/// The sets of purposes at a bounce.
const SETS: u32 = 6;

/// The index of the point that a sample uses for a set of purposes; samples of a block of 2ᵏ stay within a block.
#[inline(always)]
fn shuffled(sample: u32, set: u32) -> u32 {
    let [seed, _] = halves(super::hash::mixed(u64::from(set)));
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
        [0, 1].each(|axis| owen_scrambled(self.reversed[axis], seeds[axis]).reverse_bits())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

    /// Every block of 2ᵐ samples has one in each interval of length 2⁻ᵐ on each axis, and two numbers of one purpose are
    /// a (0, m, 2)-net; pairs of two purposes of a set have the t that theory allows (Niederreiter 1987: the sum of the
    /// degrees minus 1 each).
    #[test]
    fn nets() {
        let axes = Purpose::ALL.into_iter().flat_map(|purpose| (0..purpose.numbers()).map(move |axis| (purpose, axis)));
        let axes: Vec<(Purpose, u32)> = axes.collect();
        let (mut tried, mut worst) = (0, Vec::new());
        for (one, (first, axis)) in axes.iter().copied().enumerate() {
            for (second, other) in axes[one + 1..].iter().copied() {
                let ((set, a), (its_set, b)) = (place_of(first), place_of(second));
                if set != its_set {
                    continue;
                }
                let [of_first, of_second] = [a + axis, b + other].map(degree);
                let allowed = of_first.saturating_sub(1) + of_second.saturating_sub(1);
                assert!(first != second || set == 0 && a > 0 || allowed == 0, "{first:?} is not a (0, m, 2)-net");
                let mut largest = 0;
                for m in 0..=10_u32 {
                    for (seed, block, depth) in [(0, 0, 0), (1, 0, 0), (2, 1, 0), (3, 5, 0), (4, 0, 1), (5, 3, 2)] {
                        let pixel = PixelKey::new(seed, [7, 11]);
                        let of = |n: u32, purpose: Purpose, axis: u32| {
                            let sobol = Sobol::new(n, depth, purpose);
                            if purpose.numbers() == 2 { sobol.two(pixel)[axis as usize] } else { sobol.one(pixel) }
                        };
                        let numbers = block << m..(block + 1) << m;
                        let points: Vec<_> = numbers.map(|n| [of(n, first, axis), of(n, second, other)]).collect();
                        for axis in 0..2 {
                            let mut cells: Vec<u64> = points.iter().map(|p| u64::from(p[axis]) >> (32 - m)).collect();
                            cells.sort_unstable();
                            assert!(cells.iter().copied().eq(0..1 << m), "{first:?}, {second:?}, 2^{m} points");
                        }
                        let t = quality(&points);
                        assert!(t <= allowed, "{first:?}, {second:?}, 2^{m} points: t = {t}, but {allowed} is allowed");
                        (largest, tried) = (largest.max(t), tried + 1);
                    }
                }
                worst.push(format!("{first:?} {axis} and {second:?} {other} {largest} of {allowed}"));
            }
        }
        eprintln!("nets: {tried} blocks of 2^0 to 2^10 samples; largest t: {}", worst.join(", "));
    }

    /// Unscrambled points equal those of the crate sobol_burley, and its scrambled pairs have the same t as pinhole's.
    #[test]
    fn agrees_with_sobol_burley() {
        let (mut points, mut compared) = (0, 0);
        for dimension in 0..TOGETHER as u32 {
            for number in 0..1_u32 << 16 {
                let theirs = sobol_burley::parts::sobol_rev(number.reverse_bits(), dimension);
                assert_eq!(sobol_bits(number, dimension), theirs, "{number} in dimension {dimension}");
                points += 1;
            }
        }
        for purpose in [Purpose::Pixel, Purpose::Lens] {
            let first = place_of(purpose).1;
            for m in 0..=10_u32 {
                let theirs = |n: u32, d: u32| {
                    // Exact: 24 bits of an f32 from 0 to 1.
                    ((f64::from(sobol_burley::sample(n, d, 9)) * f64::from(1 << 24)) as u32) << 8
                };
                let burley: Vec<[u32; 2]> = (0..1 << m).map(|n| [first, first + 1].map(|d| theirs(n, d))).collect();
                let pixel = PixelKey::new(9, [0, 0]);
                let own: Vec<[u32; 2]> = (0..1 << m).map(|n| Sobol::new(n, 0, purpose).two(pixel)).collect();
                assert_eq!(quality(&own), quality(&burley), "{purpose:?}, 2^{m} points");
                compared += 1;
            }
        }
        eprintln!("sobol_burley: {points} coordinates equal to all 32 digits, {compared} nets of equal t");
    }
}
