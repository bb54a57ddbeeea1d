use super::Placement;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A cone about the entity's own y axis, its apex up; the position is half way between base and apex.
///
/// A non-uniform scale makes it elliptic.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Cone {
    /// Of its base, in scene units, above 0.
    pub radius: f64,
    /// From base to apex, in scene units, above 0.
    pub height: f64,
    /// Whether a disk closes its base; without it the inside is visible from below.
    pub capped: bool,
}

impl Default for Cone {
    fn default() -> Self {
        Self { radius: 1.0, height: 2.0, capped: true }
    }
}
