use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// The number of samples per pixel at which sampling stops if only a time or an error was asked for.
pub const OPEN_END: u32 = 65_536;

/// On the camera, beside `Sampling`: adaptive sampling, in which each pixel gets as many samples as its noise requires.
///
/// The error of a pixel is the standard error of its mean radiance, relative to that radiance:
/// √(V / n) / √(L² + 0.01), where V is the variance of a sample and L² the square of the mean, each averaged over red,
/// green and blue, and n the number of samples; its square is the relMSE that the pixel is expected to have.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Adaptive {
    /// The target error of each pixel, above 0 and at most 1.
    pub error: f64,
    /// Samples per pixel in the pilot pass, from which a pixel's number of samples is decided; at least 4, discarded
    /// afterwards.
    pub pilot: u32,
}

impl Default for Adaptive {
    fn default() -> Self {
        Self { error: 0.01, pilot: 16 }
    }
}
