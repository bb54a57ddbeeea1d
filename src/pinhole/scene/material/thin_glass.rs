use crate::scene::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A thin pane of smooth glass, as of a window: a surface without an interior, which light crosses without being bent.
///
/// It stands for both faces of the pane and all reflections between them, so that any shape may be made of it, open or
/// closed.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ThinGlass {
    /// The index of refraction of the glass, from 1 to 1000; a higher one reflects more.
    pub ior: f64,
    /// The factor of the light that is transmitted, linear Rec. 709, each component from 0 to 1.
    pub colour: Rgb,
}

impl Default for ThinGlass {
    fn default() -> Self {
        Self { ior: 1.5, colour: Rgb::grey(1.0) }
    }
}
