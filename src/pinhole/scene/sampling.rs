use super::Filter;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On the camera: how many samples each pixel gets, and where in the pixel they lie.
///
/// A camera without it traces one ray through each pixel's centre.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sampling {
    /// Samples per pixel, from 1 to 16777216.
    pub samples: u32,
    /// The seed of all random numbers.
    pub seed: u64,
    /// Which sampler the random numbers come from.
    pub sampler: Sampler,
    /// The reconstruction filter.
    pub filter: Filter,
}

impl Default for Sampling {
    fn default() -> Self {
        Self { samples: 16, seed: 0, sampler: Sampler::default(), filter: Filter::default() }
    }
}

/// A source of sample points in the unit hypercube, as in PBRT.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Sampler {
    /// Independent uniform random numbers.
    Independent,
    /// Stratified: one jittered point in each cell of a grid.
    Stratified,
    /// The Sobol sequence with Owen scrambling: well distributed at any number of samples.
    #[default]
    Sobol,
}

impl Sampler {
    /// All samplers, each with its word on the command line.
    pub const ALL: [(&str, Self); 3] =
        [("sobol", Self::Sobol), ("stratified", Self::Stratified), ("independent", Self::Independent)];
}
