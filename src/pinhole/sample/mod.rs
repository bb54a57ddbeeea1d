//! Samplers: random numbers as a function of seed, pixel, sample, bounce and purpose, and of nothing else.
//!
//! Therefore neither threads, tiles, the order of work, nor a stage that the plan drops can change one of them.
//!
//! Reads: the seed and the number of samples, nothing else of a scene.
//! Gives: 32-bit fractions, which [`unit()`] converts to f64 in [0, 1) with 24 bits.
//! Whatever all pixels of a tile have in common in one sample is computed once, in a [`Draw`]; which sampler to use is
//! decided in one place, [`with_sampler!`], outside all loops over pixels.
//!
//! ```
//! use pinhole::sample::{Purpose, uniform};
//!
//! // A random number is a function of seed, pixel, sample and purpose: no generator is carried along.
//! let number = |sample| uniform(7, [3, 4], sample, Purpose::Roulette);
//! assert_eq!(number(0), number(0));
//! let mean = (0..4096).map(number).sum::<f64>() / 4096.0;
//! assert!((mean - 0.5).abs() < 0.02);
//! ```

mod circle;
mod hash;
mod independent;
mod mean_error;
mod owen;
mod purpose;
mod sobol;
mod spectrum;
mod stratified;

pub use crate::filters::{box_offset, table_offset, tent_offset};
pub use circle::{DiskPoint, circle_point, disk_point, square_of_disk};
pub(crate) use circle::{NO_PLACES, series};
pub use hash::{PixelKey, RandomStream, unit, unit_of_ray};
pub use independent::{Independent, uniform};
pub use mean_error::{INTEGRANDS, Integrand, MeanError, mean_error, slope};
pub use owen::owen_scrambled;
pub use purpose::{DIMENSIONS, Purpose};
pub use sobol::{Sobol, sobol_bits};
pub use spectrum::{SPECTRUM, Spectrum, colour_matching};
pub use stratified::{Stratified, permuted, strata_of};

/// Which of a pixel's samples random numbers are for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SampleIndex {
    /// The index of the sample within its pixel.
    pub number: u32,
    /// The number of samples that each pixel gets.
    pub samples: u32,
    /// The bounce; 0 is the camera ray.
    pub depth: u32,
}

/// One sample's random numbers for one purpose, to be drawn for any pixel.
///
/// A sampler implements this in a file of its own, and is registered in [`with_sampler!`] and in
/// [`Sampler`](crate::scene::Sampler).
pub trait Draw: Copy {
    /// The numbers of a sample for a purpose.
    fn of(sample: SampleIndex, purpose: Purpose) -> Self;
    /// A number for a pixel, as a 32-bit fraction.
    fn one(self, pixel: PixelKey) -> u32;
    /// Two numbers for a pixel, a point of the unit square, as 32-bit fractions.
    fn two(self, pixel: PixelKey) -> [u32; 2];
}

/// Evaluates an expression with `$draw` as the type that a [`Sampler`](crate::scene::Sampler) draws its numbers with.
///
/// The expression is compiled once for each sampler, so that no loop in it depends on which one it is.
#[doc(hidden)]
#[macro_export]
macro_rules! with_sampler {
    ($sampler:expr, $draw:ident => $numbers:expr) => {
        match $sampler {
            $crate::scene::Sampler::Independent => {
                type $draw = $crate::sample::Independent;
                $numbers
            }
            $crate::scene::Sampler::Stratified => {
                type $draw = $crate::sample::Stratified;
                $numbers
            }
            $crate::scene::Sampler::Sobol => {
                type $draw = $crate::sample::Sobol;
                $numbers
            }
        }
    };
}
pub use with_sampler;
