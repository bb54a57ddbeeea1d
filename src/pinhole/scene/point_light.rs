use super::{Placement, Rgb};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A point light at the entity's position, which emits equally in all directions.
///
/// The irradiance on a surface that faces it at distance d is intensity / d².
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct PointLight {
    /// Radiant intensity, linear Rec. 709, each component finite and at least 0.
    pub intensity: Rgb,
    /// Whether objects cast shadows in its light; if not, no shadow rays are traced for it.
    pub casts_shadows: bool,
}

impl Default for PointLight {
    fn default() -> Self {
        Self { intensity: Rgb::grey(1.0), casts_shadows: true }
    }
}
