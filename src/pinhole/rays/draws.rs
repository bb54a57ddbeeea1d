use super::{Depth, Paths, PixelSamples, SampleNumber, Tile, pixel_of_row};
use crate::extract::SamplingTable;
use crate::sample::{Draw, Independent, PixelKey, Purpose, Sobol, Stratified, unit};
use crate::scene::Sampler;

/// What a tile's random numbers are made from on the leg at hand.
pub struct Draws<'a> {
    /// Seed and sampler.
    pub sampling: &'a SamplingTable,
    /// Where the tile lies.
    pub tile: &'a Tile,
    /// Which sample of each pixel runs; none for the first.
    pub number: Option<&'a SampleNumber>,
    /// The pixels of the first leg's rows; none where row and pixel are the same.
    pub samples: Option<&'a PixelSamples>,
    /// The ways of the rows; none on a first leg that nothing follows.
    pub paths: Option<&'a Paths>,
    /// The leg.
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

/// Draws a point of the unit square for each of these rows.
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

/// Draws a number from 0 to below 1 for each of these rows.
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
