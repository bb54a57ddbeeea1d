use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// The number of pixels of a camera's image, from which its aspect ratio follows.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Resolution {
    /// Pixels from left to right, at least 1.
    pub width: u32,
    /// Pixels from top to bottom, at least 1.
    pub height: u32,
}

impl Default for Resolution {
    fn default() -> Self {
        Self { width: 480, height: 270 }
    }
}
