use super::{Placement, Rgb};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A light without size at the entity's position, equally bright in all directions.
///
/// A surface at distance d that faces it receives intensity / d².
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct PointLight {
    /// Radiant intensity, linear Rec. 709, each part finite and at least 0.
    pub intensity: Rgb,
    /// Whether things in between keep its light away; without, no shadow ray is made for this light.
    pub casts_shadows: bool,
}

impl Default for PointLight {
    fn default() -> Self {
        Self { intensity: Rgb::grey(1.0), casts_shadows: true }
    }
}
