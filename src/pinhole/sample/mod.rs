//! Random numbers for samples: a function of seed, pixel, sample and purpose, and of nothing else.
//!
//! So neither threads, tiles, the order of the work nor a stage that a scene leaves out can change one.
//!
//! Reads: nothing of a scene but the seed and the number of samples that it states.
//! Gives: fractions of 32 bits, which [`unit`] makes f64 in [0, 1) with 24 bits; and points beside a pixel's centre, in
//! pixels, spread as a filter weighs.
//! What all pixels of a tile share in one sample is worked out once, in a [`Draw`]; which kind of `Draw` is decided
//! outside the loop over pixels.

mod filter;
mod hash;
mod independent;
mod mean_error;
mod owen;
mod purpose;
mod sobol;
mod stratified;

pub use filter::{box_offset, table_offset, tent_offset};
pub use hash::{PixelKey, unit};
pub use independent::{Independent, uniform};
pub use mean_error::{INTEGRANDS, Integrand, MeanError, mean_error, slope};
pub use owen::owen_scrambled;
pub use purpose::{DIMENSIONS, Purpose};
pub use sobol::{Sobol, sobol_bits};
pub use stratified::{Stratified, permuted, strata_of};

/// One sample's random numbers for one purpose, ready for any pixel.
pub trait Draw: Copy {
    /// A number for a pixel, as a fraction of 32 bits.
    fn one(self, pixel: PixelKey) -> u32;
    /// Two numbers for a pixel: a point of the unit square.
    fn two(self, pixel: PixelKey) -> [u32; 2];
}
