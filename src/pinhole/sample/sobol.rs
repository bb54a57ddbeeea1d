use super::hash::{halves, mixed};
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
/// whose points are a (0, m, 2)-net, and visits the points of a block in an order of its own. At the first bounces the
/// orders are chosen so that what light is a product of, the pixel and the directions and lights one after another, is
/// well distributed together, too; beyond, sets meet at random (padding, as in Burley 2020).
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
        let number = index_of(sample, depth, set);
        let second = first + purpose.numbers() - 1;
        let dimension = purpose.dimension(depth);
        Self { dimension, reversed: [first, second].each(|within| sobol_bits(number, within)) }
    }
}

/// The sets of purposes at a bounce.
const SETS: u32 = 6;

/// The orders in which the light, the direction and the environment's point visit their points at the first bounces.
///
/// They have one order at a bounce, since their light is added up there, and only what it is multiplied with must meet
/// them evenly. Of the orders up to 150,000 these leave least of the variance that products have where points are paired at
/// random; a test compares them with some, and with all where `PINHOLE_TEST_SAMPLES` asks for it.
const ORDERS: [u32; 5] = [73_774, 115_122, 80_623, 30_387, 115_778];

/// The index of the point that a sample uses for a set of purposes at a bounce; samples of a block of 2ᵏ stay within a
/// block.
fn index_of(sample: u32, depth: u32, set: u32) -> u32 {
    match (set, ORDERS.get(depth as usize)) {
        (0, _) if depth == 0 => sample,
        (1..=3, Some(&order)) => ordered(sample, order),
        _ => shuffled(sample, depth * SETS + set),
    }
}

// ANCHOR: ordered
/// The index of a sample's point in an order: each digit of the sample's number flips the same digit of the index, and some
/// of those below it.
///
/// Digits are flipped whatever the others are, so that sets in different orders are one digital net of more dimensions,
/// whose boxes hold equally many points if the orders are chosen well. Where it is drawn for every digit anew whether it
/// is flipped ([`shuffled`]), points that are neighbours in one set are so in the other, and the coarse products of both
/// have up to twice the variance of points that are paired at random.
fn ordered(sample: u32, order: u32) -> u32 {
    let below = |digit: u32| mixed(u64::from(order) << 32 | u64::from(digit)) as u32 & ((1 << digit) - 1);
    let digits = (0..u32::BITS).filter(|digit| sample >> digit & 1 == 1);
    digits.fold(0, |index, digit| index ^ 1 << digit ^ below(digit))
}
// ANCHOR_END: ordered

/// The same with each digit flipped or not by a hash of those above it.
#[inline(always)]
fn shuffled(sample: u32, set: u32) -> u32 {
    let [seed, _] = halves(mixed(u64::from(set)));
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

    /// For each point of a net, what a pair of samples that differ by it has in common: over all levels k of each dimension,
    /// 0.3ᵏ times 1 if their first k digits are the same, and -1 if the k-th is the first that is not. Their sum over the points
    /// is that of the gains by which scrambled points multiply the variance of the wavelets at these levels, coarse ones
    /// counting most (Owen 1997). First of the two dimensions that always serve, then of all, where the others count 0.6.
    fn in_common(set: u32, order: Option<u32>) -> [Vec<f64>; 2] {
        const LEVELS: u32 = 12;
        let ends = Purpose::ALL
            .into_iter()
            .filter(|purpose| place_of(*purpose).0 == set)
            .map(|purpose| place_of(purpose).1 + purpose.numbers());
        let dimensions = ends.max().unwrap_or(0);
        let weight = |level: u32| if level <= LEVELS { libm::pow(0.3, f64::from(level)) } else { 0.0 };
        let levels: Vec<f64> = (0..=32).map(|same| (1..=same).map(weight).sum::<f64>() - weight(same + 1)).collect();
        let of = |dimensions: u32| {
            let of_point = |point: u32| {
                let index = order.map_or(point, |order| ordered(point, order));
                let of_dimension = |dimension: u32| {
                    let counts = if dimension < 2 { 1.0 } else { 0.6 };
                    1.0 + counts * levels[sobol_bits(index, dimension).trailing_zeros() as usize]
                };
                (0..dimensions).map(of_dimension).product::<f64>() - 1.0
            };
            (0..1 << 10).map(of_point).collect()
        };
        [of(2), of(dimensions)]
    }

    /// The gains of products of sets over what they are where points are paired at random, on average over the sizes.
    fn left_of_random(sets: &[&[f64]]) -> f64 {
        let sizes = sets.len() + 1..=10;
        let of_size = |digits: usize| {
            let others = (1 << digits) - 1;
            let product = |of: &dyn Fn(&[f64]) -> f64| sets.iter().map(|set| of(set)).product::<f64>();
            let sum: f64 = (0..=others).map(|point| product(&|set| set[point])).sum();
            let mean = |set: &[f64]| set[1..=others].iter().sum::<f64>() / others as f64;
            sum / (product(&|set| set[0]) + others as f64 * product(&mean))
        };
        sizes.clone().map(of_size).sum::<f64>() / sizes.count() as f64
    }

    /// What an order leaves at a bounce, beside the orders of those before: of pairs, and of products of three.
    fn left_by(order: u32, before: &[[Vec<f64>; 2]]) -> f64 {
        let (mut left, bounces) = (0.0, before.len() - 1);
        for (set, share) in [(2, 0.5), (1, 0.35), (3, 0.15)] {
            let added = in_common(set, Some(order));
            let pair = |other: &[Vec<f64>; 2]| {
                let [of_two, of_all] = [0, 1].each(|which| left_of_random(&[&other[which], &added[which]]));
                0.75 * of_two + 0.25 * of_all
            };
            // Each bounce before counts as much as any, and the pixel less by as many as are between.
            let (mut sum, mut counts) = (0.0, 0.0);
            for (number, other) in before.iter().enumerate() {
                let counted = libm::pow(0.6, if number == 0 { bounces } else { bounces - 1 } as f64);
                (sum, counts) = (sum + counted * pair(other), counts + counted);
            }
            left += share * sum / counts;
            if set == 2 && bounces > 0 {
                let triples: Vec<f64> = (0..=bounces)
                    .flat_map(|one| (one + 1..=bounces).map(move |other| (one, other)))
                    .map(|(one, other)| left_of_random(&[&before[one][0], &before[other][0], &added[0]]))
                    .collect();
                left += 0.4 * triples.iter().sum::<f64>() / triples.len() as f64;
            }
        }
        left
    }

    #[test]
    fn no_order_is_better_than_those_that_are_taken() {
        let times: u32 = std::env::var("PINHOLE_TEST_SAMPLES").ok().and_then(|text| text.parse().ok()).unwrap_or(1);
        let candidates = 150_000.min(500 * times);
        let mut before = vec![in_common(0, None)];
        let (mut tried, mut said) = (0, Vec::new());
        for chosen in ORDERS {
            let chosen_leaves = left_by(chosen, &before);
            for order in 1..=candidates {
                let left = left_by(order, &before);
                assert!(left >= chosen_leaves, "order {order} leaves {left}, and {chosen} leaves {chosen_leaves}");
                tried += 1;
            }
            said.push(format!("{chosen_leaves:.3}"));
            before.push(in_common(2, Some(chosen)));
        }
        eprintln!("orders: {tried} others leave more than {} of what random pairs leave", said.join(", "));
    }

    /// A product of two numbers less their means, one of the pixel or of a bounce and one of a later bounce, has on average far
    /// less variance than where points are paired at random, whose variance is known: (1/12)² / (N - 1).
    ///
    /// With every set shuffled it is about twice that. Sixteen samples have too few digits for fifteen pairs: some of them are
    /// no better than shuffled.
    #[test]
    fn what_is_multiplied_is_stratified_together() {
        const PIXELS: u32 = 1500;
        let centred = |fraction: u32| f64::from(fraction) / (u64::from(u32::MAX) + 1) as f64 - 0.5;
        let variance = |[first, second]: [(Purpose, u32); 2], samples: u32| {
            let mut squares = 0.0;
            for number in 0..PIXELS {
                let pixel = PixelKey::new(17, [number, 3]);
                let mut sums = [0.0; 4];
                for sample in 0..samples {
                    let of = |(purpose, depth)| Sobol::new(sample, depth, purpose).two(pixel).each(centred);
                    let [[a, b], [c, d]] = [of(first), of(second)];
                    sums.iter_mut().zip([a * c, a * d, b * c, b * d]).for_each(|(sum, product)| *sum += product);
                }
                squares += sums.iter().map(|sum| sum / f64::from(samples)).map(|mean| mean * mean).sum::<f64>();
            }
            squares / f64::from(4 * PIXELS)
        };
        let later = [Purpose::LightPoint, Purpose::Direction, Purpose::EnvironmentPoint];
        for (samples, bound) in [(16, 1.3), (64, 0.4), (256, 0.25)] {
            let at_random = 1.0 / 144.0 / f64::from(samples - 1);
            let (mut sum, mut tried, mut worst) = (0.0, 0, 0.0_f64);
            for second in 0..ORDERS.len() as u32 {
                let before = (0..second).map(|depth| (Purpose::Direction, depth));
                for first in [(Purpose::Pixel, 0)].into_iter().chain(before) {
                    for purpose in later {
                        let ratio = variance([first, (purpose, second)], samples) / at_random;
                        (sum, tried, worst) = (sum + ratio, tried + 1, worst.max(ratio));
                    }
                }
            }
            let mean = sum / f64::from(tried);
            eprintln!(
                "orders: {tried} products of {samples} samples, {mean:.2} of random pairs' variance, at most {worst:.2}"
            );
            assert!(mean < bound, "{samples} samples: {mean}");
        }
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
