use glam::DVec3;

use crate::each::Each;

/// A hash of a pixel and the seed, from which the pixel's random numbers are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelKey(u64);

impl PixelKey {
    /// The key of a pixel, whose coordinates count from the top left corner of the whole image.
    #[inline(always)]
    pub fn new(seed: u64, pixel: [u32; 2]) -> Self {
        Self(mixed(mixed(seed) ^ (u64::from(pixel[0]) | u64::from(pixel[1]) << 32)))
    }

    /// 64 random bits for a dimension and an index within it.
    #[inline(always)]
    pub(super) fn bits(self, dimension: u32, number: u32) -> u64 {
        mixed(self.0 ^ (u64::from(number) | u64::from(dimension) << 32))
    }
}

/// A hash in which each bit of the result depends on every bit of the argument.
///
/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014).
#[inline(always)]
pub(super) fn mixed(bits: u64) -> u64 {
    let mut z = bits.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// A number in [0, 1) that depends on every bit of a ray and of a salt.
///
/// As PBRT-4 decides whether a ray hits a surface with an alpha (`GeometricPrimitive::Intersect`).
#[inline(always)]
pub fn unit_of_ray(ray: [DVec3; 2], salt: u64) -> f64 {
    unit(halves(RandomStream::of_ray(ray, salt).0)[0])
}

/// Random numbers without an end, for what may need any number of them: a hash of a ray and of a salt, and hashes of that
/// hash counted on (SplitMix64).
#[derive(Clone, Copy, Debug)]
pub struct RandomStream(u64);

impl RandomStream {
    /// The stream that depends on every bit of a ray and of a salt.
    #[inline(always)]
    pub fn of_ray(ray: [DVec3; 2], salt: u64) -> Self {
        let parts = ray.each(|vector| vector.to_array());
        Self(parts.as_flattened().iter().fold(mixed(salt), |bits, part| mixed(bits ^ part.to_bits())))
    }

    /// The next number in [0, 1).
    #[inline(always)]
    pub fn next_unit(&mut self) -> f64 {
        let bits = self.0;
        self.0 = bits.wrapping_add(0x9E37_79B9_7F4A_7C15);
        unit(halves(mixed(bits))[0])
    }
}

/// The two halves of 64 bits.
#[inline(always)]
pub(super) fn halves(bits: u64) -> [u32; 2] {
    [(bits >> 32) as u32, bits as u32]
}

// ANCHOR: unit
/// Converts a 32-bit fraction to a number in [0, 1), keeping its first 24 bits.
///
/// An f64 could hold all 32; but 24 also fit an f32, and f64 does not round them when a pixel index below 2²⁹ is added.
#[inline(always)]
pub fn unit(bits: u32) -> f64 {
    f64::from(bits >> 8) * (1.0 / f64::from(1 << 24))
}
// ANCHOR_END: unit

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_fraction_stays_below_one_at_the_last_pixel() {
        assert_eq!(unit(0), 0.0);
        assert_eq!(unit(u32::MAX), 1.0 - 1.0 / f64::from(1 << 24));
        assert!((unit(u32::MAX) as f32) < 1.0);
        for pixel in [0_u32, 1, 65_534, 65_535, (1 << 29) - 1] {
            for bits in [0, 1 << 8, 1 << 31, u32::MAX - 255, u32::MAX] {
                let raster = f64::from(pixel) + unit(bits);
                assert_eq!(raster.floor(), f64::from(pixel));
                assert_eq!(raster - f64::from(pixel), unit(bits), "no bit is lost");
            }
        }
    }

    /// Flipping any bit of seed, pixel, sample or dimension must flip each bit of the result with probability 1/2.
    #[test]
    fn avalanche() {
        const TRIALS: u32 = 4096;
        let at = |seed, x, y, dimension, sample| PixelKey::new(seed, [x, y]).bits(dimension, sample);
        let (mut worst, mut pairs) = (0.0_f64, 0);
        for flipped in 0..64 + 4 * 32 {
            let mut flips = [0_u32; 64];
            for trial in 0..TRIALS {
                // Small numbers, as scenes have them.
                let (seed, x, y) = (u64::from(trial % 7), trial % 61, trial / 61);
                let (dimension, sample) = (trial % 16, trial % 251);
                let one =
                    |word: u32| if flipped >= 64 && (flipped - 64) / 32 == word { 1 << (flipped % 32) } else { 0 };
                let other_seed = if flipped < 64 { seed ^ 1 << flipped } else { seed };
                let other = at(other_seed, x ^ one(0), y ^ one(1), dimension ^ one(2), sample ^ one(3));
                let changed = other ^ at(seed, x, y, dimension, sample);
                flips.iter_mut().enumerate().for_each(|(bit, flips)| *flips += (changed >> bit & 1) as u32);
            }
            for flips in flips {
                worst = worst.max((f64::from(flips) / f64::from(TRIALS) - 0.5).abs());
                pairs += 1;
            }
        }
        // 5 standard deviations of that many fair coin tosses; among 12,288 pairs one would exceed it once in 150 runs.
        let limit = 5.0 * 0.5 / f64::from(TRIALS).sqrt();
        eprintln!("avalanche: {pairs} pairs of bits × {TRIALS} trials, worst {worst:.4} from 1/2, limit {limit:.4}");
        assert!(worst < limit);
    }
}
