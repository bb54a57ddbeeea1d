use super::Placement;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A cylinder about the entity's own y axis, centred on its position; a non-uniform scale makes it elliptic.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Cylinder {
    /// In scene units, above 0.
    pub radius: f64,
    /// From end to end, in scene units, above 0.
    pub height: f64,
    /// Whether disks close both ends; without them it is a tube, visible from both sides.
    pub capped: bool,
}

impl Default for Cylinder {
    fn default() -> Self {
        Self { radius: 1.0, height: 2.0, capped: true }
    }
}
