use super::{Placement, Rgb};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A light so far away that its rays are parallel, as the sun's are.
///
/// They go along the entity's own −z, which a [`LookAt`](super::LookAt) points from its eye to its target; where the
/// entity stands does not matter.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct DirectionalLight {
    /// What a surface that faces it receives, linear Rec. 709, each part finite and at least 0.
    pub irradiance: Rgb,
    /// Whether things in between keep its light away; without, no shadow ray is made for this light.
    pub casts_shadows: bool,
}

impl Default for DirectionalLight {
    fn default() -> Self {
        Self { irradiance: Rgb::grey(1.0), casts_shadows: true }
    }
}
