use super::Placement;
use bevy_ecs::prelude::*;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A box aligned with the entity's axes and centred on its position.
///
/// Under a parent with non-uniform scale it may become a parallelepiped.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Cuboid {
    /// The edge lengths along the entity's x, y and z axes; scene units, above 0.
    pub size: DVec3,
}

impl Default for Cuboid {
    fn default() -> Self {
        Self { size: DVec3::splat(2.0) }
    }
}
