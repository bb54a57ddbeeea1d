use super::hash::halves;
use super::{Draw, PixelKey, Purpose, unit};

/// Each number by itself, as if thrown by dice.
#[derive(Clone, Copy, Debug)]
pub struct Independent {
    dimension: u32,
    sample: u32,
}

impl Independent {
    /// A sample's numbers for a purpose on a leg of the light's way.
    #[inline(always)]
    pub fn new(sample: u32, depth: u32, purpose: Purpose) -> Self {
        Self { dimension: purpose.dimension(depth), sample }
    }
}

impl Draw for Independent {
    #[inline(always)]
    fn one(self, pixel: PixelKey) -> u32 {
        self.two(pixel)[0]
    }

    #[inline(always)]
    fn two(self, pixel: PixelKey) -> [u32; 2] {
        halves(pixel.bits(self.dimension, self.sample))
    }
}

/// A number from 0 to below 1, of 24 bits, the same whenever it is asked for with the same arguments: the first of an
/// independent sampler's numbers on the first leg.
#[inline(always)]
pub fn uniform(seed: u64, pixel: [u32; 2], sample: u32, purpose: Purpose) -> f64 {
    unit(Independent::new(sample, 0, purpose).one(PixelKey::new(seed, pixel)))
}
