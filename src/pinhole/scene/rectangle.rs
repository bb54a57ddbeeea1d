use super::Placement;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A rectangle centred on the entity's position, in the entity's xz plane, visible from both sides.
///
/// Under a parent with non-uniform scale it may become a parallelogram.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Rectangle {
    /// Its extent along the entity's x axis, edge to edge; scene units, above 0.
    pub width: f64,
    /// Its extent along the entity's z axis, edge to edge; scene units, above 0.
    pub depth: f64,
}

impl Default for Rectangle {
    fn default() -> Self {
        Self { width: 2.0, depth: 2.0 }
    }
}
