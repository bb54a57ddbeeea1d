use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// Where samples run out that nobody has counted: those of a time or of an error alone.
pub const OPEN_END: u32 = 65_536;

/// On the camera, beside `Sampling`: each pixel gets as many samples as its own noise asks for.
///
/// The error of a pixel is the standard error of its mean radiance, relative to that radiance:
/// √(V / n) / √(L² + 0.01), where V is the variance of a sample and L² the square of the mean, each averaged over red,
/// green and blue, and n the number of samples; its square is the relMSE that the pixel is expected to have.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Adaptive {
    /// The error that each pixel is to have, above 0 and at most 1.
    pub error: f64,
    /// Samples a pixel from which its number of samples is decided, at least 4; they are thrown away afterwards.
    pub pilot: u32,
}

impl Default for Adaptive {
    fn default() -> Self {
        Self { error: 0.01, pilot: 16 }
    }
}
