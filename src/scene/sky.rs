//! What is seen, and what shines, where no shape is.

use super::{Degrees, Rgb};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A constant environment: the radiance along rays that hit nothing; black if the scene has none.
///
/// At most one entity may have it, and only if the scene has neither a [`Gradient`](super::Gradient) nor an
/// [`Environment`](super::Environment).
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Background {
    /// Radiance in linear Rec. 709, each component finite and at least 0.
    pub colour: Rgb,
}

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

/// An environment map: radiance from infinitely far away, as an equirectangular image with longitude from left to right
/// and latitude from top to bottom.
///
/// The centre of the image lies along −z, its right half towards +x, and its top row around +y.
/// At most one entity may have it, and only if the scene has no other background.
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Environment {
    /// A .hdr or .exr file of linear radiance, or a .png, .jpg, .tga or .bmp in sRGB; its path is relative to the scene file's folder, or to the current
    /// folder if there is no scene file.
    pub file: String,
    /// Its rotation about +y, by the right-hand rule: 90° brings the image's centre from −z to −x.
    pub turn: Degrees,
    /// A factor on the image's radiance; finite and at least 0.
    pub scale: f64,
}

impl Default for Environment {
    fn default() -> Self {
        Self { file: String::new(), turn: Degrees(0.0), scale: 1.0 }
    }
}
