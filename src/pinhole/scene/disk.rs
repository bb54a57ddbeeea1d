use super::Placement;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A disk centred on the entity's position, in the entity's xz plane, visible from both sides.
///
/// A non-uniform scale turns it into an ellipse.
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
