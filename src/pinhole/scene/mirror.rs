use super::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A perfect mirror: all light leaves at the angle at which it came, on the other side of the normal.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Mirror {
    /// The share of the light that is sent on, the same at all angles, linear Rec. 709, each part from 0 to 1.
    pub colour: Rgb,
}

impl Default for Mirror {
    fn default() -> Self {
        Self { colour: Rgb::grey(0.9) }
    }
}
