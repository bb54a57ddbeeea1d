use super::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A background that changes from below to above: with t = (y + 1) / 2 of a ray's unit direction, (1 − t) bottom + t top.
///
/// At most one entity may carry it, and none together with another background.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Gradient {
    /// Straight down: linear Rec. 709 radiance, each part finite and at least 0.
    pub bottom: Rgb,
    /// Straight up.
    pub top: Rgb,
}

impl Default for Gradient {
    fn default() -> Self {
        Self { bottom: Rgb::grey(1.0), top: Rgb::new(0.5, 0.7, 1.0) }
    }
}
