use super::Placement;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A sphere centred on the entity's position; a non-uniform scale turns it into an ellipsoid.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Sphere {
    /// In scene units, above 0.
    pub radius: f64,
}

impl Default for Sphere {
    fn default() -> Self {
        Self { radius: 1.0 }
    }
}
