use super::Placement;
use bevy_ecs::prelude::*;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A box with its faces across the entity's axes, the entity's position at its middle.
///
/// Parents that scale unevenly may make it a parallelepiped.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Cuboid {
    /// From face to face along the entity's x, y and z axes; scene units, above 0.
    pub size: DVec3,
}

impl Default for Cuboid {
    fn default() -> Self {
        Self { size: DVec3::splat(2.0) }
    }
}
