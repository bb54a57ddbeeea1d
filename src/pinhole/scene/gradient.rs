use super::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A background that blends two radiances along y: (1 − t) bottom + t top with t = (y + 1) / 2 of a ray's unit
/// direction.
///
/// At most one entity may have it, and only if the scene has no other background.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Gradient {
    /// The radiance from straight below, linear Rec. 709, each component finite and at least 0.
    pub bottom: Rgb,
    /// The radiance from straight above.
    pub top: Rgb,
}

impl Default for Gradient {
    fn default() -> Self {
        Self { bottom: Rgb::grey(1.0), top: Rgb::new(0.5, 0.7, 1.0) }
    }
}
