use super::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A surface that shines by itself, on both sides and equally in all directions.
///
/// It may stand beside a material or alone; a shape with an `Emissive` alone reflects nothing.
/// Put it on the shape, or on the entity whose material the shape uses; the shape's own goes first.
/// What it emits is seen by camera rays; it lights other surfaces where the integrator follows light to it.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Emissive {
    /// The radiance that leaves every point, linear Rec. 709, each part finite and at least 0.
    pub radiance: Rgb,
}

impl Default for Emissive {
    fn default() -> Self {
        Self { radiance: Rgb::grey(1.0) }
    }
}
