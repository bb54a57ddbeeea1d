use super::Placement;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A flat piece with four corners, in the entity's xz plane, the entity's position at its middle, seen from both sides.
///
/// Parents that scale unevenly may make it a parallelogram.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Rectangle {
    /// How far it reaches along the entity's x axis, edge to edge; scene units, above 0.
    pub width: f64,
    /// How far it reaches along the entity's z axis, edge to edge; scene units, above 0.
    pub depth: f64,
}

impl Default for Rectangle {
    fn default() -> Self {
        Self { width: 2.0, depth: 2.0 }
    }
}
