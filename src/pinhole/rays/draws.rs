use super::{Depth, Paths, PixelSamples, SampleNumber, Tile, pixel_of_row};
use crate::extract::SamplingTable;
use crate::sample::{Draw, Independent, PixelKey, Purpose, Sobol, Stratified, unit};
use crate::scene::Sampler;

/// Everything that determines a tile's random numbers at the current bounce.
pub struct Draws<'a> {
    /// The seed and the sampler.
    pub sampling: &'a SamplingTable,
    /// The tile's rectangle in the image.
    pub tile: &'a Tile,
    /// The index of the current sample of each pixel; `None` means 0.
    pub number: Option<&'a SampleNumber>,
    /// The pixels of the camera rays' rows; `None` if row and pixel coincide.
    pub samples: Option<&'a PixelSamples>,
    /// The paths of the rows; `None` if the scene has no bounces.
    pub paths: Option<&'a Paths>,
    /// The current depth.
    pub depth: Depth,
}

impl Draws<'_> {
    fn keys<'r>(&'r self, rows: &'r [u32]) -> impl Iterator<Item = PixelKey> + 'r {
        rows.iter().map(|&row| {
            PixelKey::new(self.sampling.seed, pixel_of_row(self.tile, self.samples, self.paths, row as usize))
        })
    }

    fn number(&self) -> u32 {
        self.number.map_or(0, |number| number.0)
    }
}

/// Draws a uniform point in [0, 1)² for each of these rows.
pub fn draws_of_two(of: &Draws<'_>, purpose: Purpose, rows: &[u32], into: &mut Vec<[f64; 2]>) {
    fn fill<D: Draw>(draw: D, keys: impl Iterator<Item = PixelKey>, into: &mut Vec<[f64; 2]>) {
        into.extend(keys.map(|key| draw.two(key).map(unit)));
    }
    into.clear();
    let (number, depth, keys) = (of.number(), of.depth.0, of.keys(rows));
    match of.sampling.sampler {
        Sampler::Independent => fill(Independent::new(number, depth, purpose), keys, into),
        Sampler::Stratified => fill(Stratified::new(number, of.sampling.samples, depth, purpose), keys, into),
        Sampler::Sobol => fill(Sobol::new(number, depth, purpose), keys, into),
    }
}

/// Draws a uniform number in [0, 1) for each of these rows.
pub fn draws_of_one(of: &Draws<'_>, purpose: Purpose, rows: &[u32], into: &mut Vec<f64>) {
    fn fill<D: Draw>(draw: D, keys: impl Iterator<Item = PixelKey>, into: &mut Vec<f64>) {
        into.extend(keys.map(|key| unit(draw.one(key))));
    }
    into.clear();
    let (number, depth, keys) = (of.number(), of.depth.0, of.keys(rows));
    match of.sampling.sampler {
        Sampler::Independent => fill(Independent::new(number, depth, purpose), keys, into),
        Sampler::Stratified => fill(Stratified::new(number, of.sampling.samples, depth, purpose), keys, into),
        Sampler::Sobol => fill(Sobol::new(number, depth, purpose), keys, into),
    }
}
