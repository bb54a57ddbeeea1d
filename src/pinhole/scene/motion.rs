use bevy_ecs::prelude::*;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// On the camera: from when to when it gathers light.
///
/// Everything stands where its placement says at time 0; what has a [`Motion`] is elsewhere at other times.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Shutter {
    /// When it opens, in units of time.
    pub open: f64,
    /// When it closes, not before it opens; at the same time, the picture shows one moment.
    pub close: f64,
}

impl Default for Shutter {
    fn default() -> Self {
        Self { open: 0.0, close: 1.0 }
    }
}

/// On a sphere, a disk, a rectangle, the camera, or a group of them: it moves in a straight line.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Motion {
    /// Along the world's axes, in scene units per unit of time, however its parents are turned; theirs is added.
    pub velocity: DVec3,
}
