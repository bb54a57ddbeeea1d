use crate::scene::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A rough dielectric, such as frosted glass: microfacets with a GGX (Trowbridge–Reitz) distribution of normals, each of
/// which reflects and refracts as smooth glass does.
///
/// The shape must be closed, or divide all of space in two; glass fills the side that its normal points away from.
/// Light that would hit a second microfacet is lost.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RoughGlass {
    /// The index of refraction relative to vacuum, from 0.001 to 1000; a higher one bends light more.
    pub ior: f64,
    /// GGX's α, from 0 to 1; below 0.001 the surface is smooth glass.
    pub roughness: f64,
    /// The absorption coefficient per scene unit: by Beer's law e^(−absorption · length) is transmitted; each component
    /// at least 0.
    pub absorption: Rgb,
    /// Where dielectrics overlap, the one of highest priority fills the space.
    pub priority: u32,
}

impl Default for RoughGlass {
    fn default() -> Self {
        Self { ior: 1.5, roughness: 0.2, absorption: Rgb::BLACK, priority: 0 }
    }
}
