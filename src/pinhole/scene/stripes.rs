use super::{Rgb, TextureBy};
use bevy_ecs::prelude::*;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// On a material: two colours in turn along one direction, in place of the material's own colour.
///
/// By uv the first stripe begins at (0, 0); by space it has its middle at the shape's origin.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Stripes {
    /// The one colour: the share of the light that is sent on, linear Rec. 709, each part from 0 to 1.
    pub first: Rgb,
    /// The other.
    pub second: Rgb,
    /// The width of a stripe, in units of uv or of the shape's space, above 0.
    pub size: f64,
    /// Across the stripes, of any length but 0; by uv only its x and y count, along u and v.
    pub across: DVec3,
    /// What they are laid along.
    pub by: TextureBy,
    /// Whether a pixel gets the mean of what it covers; without, the colour at one point.
    pub filter: bool,
}

impl Default for Stripes {
    fn default() -> Self {
        let (first, second) = (Rgb::grey(0.8), Rgb::grey(0.2));
        Self { first, second, size: 1.0, across: DVec3::X, by: TextureBy::default(), filter: true }
    }
}
