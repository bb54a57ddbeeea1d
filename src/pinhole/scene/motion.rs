use bevy_ecs::prelude::*;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// On the camera: the interval of time during which it gathers light.
///
/// Every entity is where its placement says at time 0; one with a [`Motion`] is elsewhere at other times.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Shutter {
    /// When it opens, in units of time.
    pub open: f64,
    /// When it closes, not before it opens; if both are equal, the picture shows one instant.
    pub close: f64,
}

impl Default for Shutter {
    fn default() -> Self {
        Self { open: 0.0, close: 1.0 }
    }
}

/// On a shape of any kind, the camera, or a group of them: motion at constant velocity.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Motion {
    /// In world space, in scene units per unit of time, however the parents are rotated; their velocities are added.
    pub velocity: DVec3,
}
