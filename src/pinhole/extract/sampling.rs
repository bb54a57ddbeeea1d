use super::camera_entity::camera_of;
use super::check::kind_and_name;
use crate::plan::{Census, Table};
use crate::scene::{Sampler, Sampling, SceneError};
use bevy_ecs::prelude::*;

/// The greatest number of samples per pixel: the number of positions along an axis that 24 bits distinguish.
pub const MAX_SAMPLES: u32 = 1 << 24;

/// How the camera samples its pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SamplingTable {
    /// Samples per pixel.
    pub samples: u32,
    /// The seed of all random numbers.
    pub seed: u64,
    /// The sampler that makes them.
    pub sampler: Sampler,
}

impl SamplingTable {
    /// The same with another seed, for samples that must be independent of these with any sampler.
    pub fn for_pilot(self) -> Self {
        Self { seed: self.seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x50_494C_4F54, ..self }
    }

    /// The random numbers of light paths, from another seed.
    ///
    /// Stratification counts the samples of a pixel, which a light path does not have, so its numbers are independent.
    pub fn for_light_paths(self) -> Self {
        let sampler = if self.sampler == Sampler::Sobol { Sampler::Sobol } else { Sampler::Independent };
        Self { seed: self.seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x4C_4947_4854, sampler, ..self }
    }
}

impl Table for SamplingTable {
    const NAME: &'static str = "sampling";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let camera = camera_of(scene)?;
        let Some(&Sampling { samples, seed, sampler, .. }) = scene.get::<Sampling>(camera) else {
            return Ok(Self { samples: 1, ..Self::default() });
        };
        if !(1..=MAX_SAMPLES).contains(&samples) {
            let who = kind_and_name(scene, "camera", camera);
            let accepted = format!("it must be a whole number from 1 to {MAX_SAMPLES}");
            return Err(SceneError::new(who, "samples", samples.to_string(), accepted));
        }
        Ok(Self { samples, seed, sampler })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}
