use crate::scene::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A perfect mirror: a specular reflector, whose BRDF is a delta distribution about the mirrored direction.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Mirror {
    /// Its reflectance, the same at all angles, linear Rec. 709, each component from 0 to 1.
    pub colour: Rgb,
}

impl Default for Mirror {
    fn default() -> Self {
        Self { colour: Rgb::grey(0.9) }
    }
}
