use super::Filter;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On the camera: how many rays look through each pixel, and where in it.
///
/// A camera without it sends one ray through each pixel's centre.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sampling {
    /// Samples a pixel, from 1 to 16777216.
    pub samples: u32,
    /// Another seed, other random numbers.
    pub seed: u64,
    /// Where the random numbers come from.
    pub sampler: Sampler,
    /// What a sample counts for, by its distance from the pixel's centre.
    pub filter: Filter,
}

impl Default for Sampling {
    fn default() -> Self {
        Self { samples: 16, seed: 0, sampler: Sampler::default(), filter: Filter::default() }
    }
}

/// Where the random numbers of samples come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Sampler {
    /// Each number by itself.
    Independent,
    /// One in each cell of a grid, at random within it.
    Stratified,
    /// Points of the Sobol sequence, scrambled: evenly spread at any number of samples.
    #[default]
    Sobol,
}

impl Sampler {
    /// All, with the words of the command line.
    pub const ALL: [(&str, Self); 3] =
        [("sobol", Self::Sobol), ("stratified", Self::Stratified), ("independent", Self::Independent)];
}
