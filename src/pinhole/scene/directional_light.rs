use super::{Placement, Rgb};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A light so distant that its rays are parallel, as sunlight is (a delta distribution over directions).
///
/// They travel along the entity's own −z, which a [`LookAt`](super::LookAt) points from its eye to its target; the
/// entity's position has no effect.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct DirectionalLight {
    /// The irradiance on a surface that faces the light, linear Rec. 709, each component finite and at least 0.
    pub irradiance: Rgb,
    /// Whether objects cast shadows in its light; if not, no shadow rays are traced for it.
    pub casts_shadows: bool,
}

impl Default for DirectionalLight {
    fn default() -> Self {
        Self { irradiance: Rgb::grey(1.0), casts_shadows: true }
    }
}
