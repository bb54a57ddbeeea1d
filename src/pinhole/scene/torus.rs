use super::Placement;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A torus about the entity's own y axis: a tube around a circle about its position.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Torus {
    /// Of the circle in the middle of the tube, in scene units, above 0.
    pub radius: f64,
    /// The radius of the tube, in scene units, above 0 and less than that of the circle, so that there is a hole.
    pub tube: f64,
}

impl Default for Torus {
    fn default() -> Self {
        Self { radius: 1.0, tube: 0.25 }
    }
}
