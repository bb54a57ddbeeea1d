use super::{Rgb, TextureBy};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On a material: two colours in turn, in squares by uv or in cubes by space, in place of the material's own colour.
///
/// By uv a square begins at (0, 0); by space a cube of the first colour has its middle at the shape's origin, so that no
/// flat shape lies between two layers.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Checker {
    /// The one colour: the share of the light that is sent on, linear Rec. 709, each part from 0 to 1.
    pub first: Rgb,
    /// The other.
    pub second: Rgb,
    /// The side of a square or cube, in units of uv or of the shape's space, above 0.
    pub size: f64,
    /// What it is laid along.
    pub by: TextureBy,
    /// Whether a pixel gets the mean of what it covers; without, the colour at one point.
    pub filter: bool,
}

impl Default for Checker {
    fn default() -> Self {
        let (first, second) = (Rgb::grey(0.8), Rgb::grey(0.2));
        Self { first, second, size: 1.0, by: TextureBy::default(), filter: true }
    }
}
