use super::Placement;
use bevy_ecs::prelude::*;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// An infinite plane through the entity's position.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Plane {
    /// Perpendicular to the plane, in the entity's space; any length but 0.
    pub normal: DVec3,
}

impl Default for Plane {
    fn default() -> Self {
        Self { normal: DVec3::Y }
    }
}
