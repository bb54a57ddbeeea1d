use super::Degrees;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

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
