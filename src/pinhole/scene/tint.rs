use super::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// Factors by which the colour of a material is multiplied, that of its texture included; model files give them.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tint {
    /// By which the colour of the material or of its texture is multiplied, each part from 0 to 1.
    pub factor: Rgb,
    /// Whether the colours of a mesh's vertices are a factor, too.
    pub by_vertex: bool,
}

impl Default for Tint {
    /// Changes nothing.
    fn default() -> Self {
        Self { factor: Rgb::grey(1.0), by_vertex: false }
    }
}
