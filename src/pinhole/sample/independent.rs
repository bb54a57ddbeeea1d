use super::hash::halves;
use super::{Draw, PixelKey, Purpose, SampleIndex, unit};

/// The independent sampler: every number is uniform in [0, 1) and independent of all others.
#[derive(Clone, Copy, Debug)]
pub struct Independent {
    dimension: u32,
    sample: u32,
}

impl Independent {
    /// A sample's numbers for a purpose at a bounce.
    #[inline(always)]
    pub fn new(sample: u32, depth: u32, purpose: Purpose) -> Self {
        Self { dimension: purpose.dimension(depth), sample }
    }
}

impl Draw for Independent {
    #[inline(always)]
    fn of(sample: SampleIndex, purpose: Purpose) -> Self {
        Self::new(sample.number, sample.depth, purpose)
    }

    #[inline(always)]
    fn one(self, pixel: PixelKey) -> u32 {
        self.two(pixel)[0]
    }

    #[inline(always)]
    fn two(self, pixel: PixelKey) -> [u32; 2] {
        halves(pixel.bits(self.dimension, self.sample))
    }
}

/// A uniform number in [0, 1), of 24 bits, determined by its arguments: the independent sampler's first number at depth
/// 0.
#[inline(always)]
pub fn uniform(seed: u64, pixel: [u32; 2], sample: u32, purpose: Purpose) -> f64 {
    unit(Independent::new(sample, 0, purpose).one(PixelKey::new(seed, pixel)))
}
