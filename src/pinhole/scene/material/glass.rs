use crate::scene::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A smooth dielectric: light is specularly reflected and refracted, in the proportion that Fresnel's equations give.
///
/// The shape must be closed, or divide all of space in two; glass fills the side that its normal points away from.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Glass {
    /// The index of refraction relative to vacuum, above 0; a higher one bends light more.
    pub ior: f64,
    /// The absorption coefficient per scene unit: by Beer's law e^(−absorption · length) is transmitted; each component
    /// at least 0.
    pub absorption: Rgb,
    /// Where dielectrics overlap, the one of highest priority fills the space.
    pub priority: u32,
}

impl Default for Glass {
    fn default() -> Self {
        Self { ior: 1.5, absorption: Rgb::BLACK, priority: 0 }
    }
}
