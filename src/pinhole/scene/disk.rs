use super::Placement;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A flat round piece about the entity's position, in the entity's xz plane, seen from both sides.
///
/// Any placement may scale it unevenly: then it is an ellipse.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Disk {
    /// In scene units, above 0.
    pub radius: f64,
}

impl Default for Disk {
    fn default() -> Self {
        Self { radius: 1.0 }
    }
}
