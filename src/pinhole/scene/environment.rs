use super::Degrees;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A background from an image of all directions, equirectangular: longitude from left to right, latitude from top to bottom.
///
/// The middle of the image lies along −z, its right half on the side of +x, its top row around +y.
/// At most one entity may carry it, and none together with another background.
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Environment {
    /// A .hdr or .exr of linear radiance; relative to the scene file's folder, or to the current one where there is no
    /// scene file.
    pub file: String,
    /// How far it is turned about +y, by the right-hand rule: by 90° the image's middle comes from −z to −x.
    pub turn: Degrees,
    /// The image's numbers are multiplied by it; finite and at least 0.
    pub scale: f64,
}

impl Default for Environment {
    fn default() -> Self {
        Self { file: String::new(), turn: Degrees(0.0), scale: 1.0 }
    }
}
