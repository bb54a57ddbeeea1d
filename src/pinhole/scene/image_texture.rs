use super::{FileKind, TextureBy, Wrap};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A file that a texture or an environment names.
pub const IMAGE_FILE: FileKind = FileKind { name: "an image", most: 1 << 30 };

/// On a material: the colours of an image file, in place of the material's own colour.
///
/// By uv its upper left corner is at (0, 0), its x grows with u, and its y, downward, with v.
/// By space its middle is at the shape's origin, and it is laid along the two axes of the side that the surface faces, as on
/// a cuboid: upright on sides that face x or z, and seen from outside never mirrored.
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ImageTexture {
    /// A .png, in sRGB, or a .hdr or .exr, in linear floats from 0 to 1; relative to the scene file's folder, or to the
    /// current one where there is no scene file.
    pub file: String,
    /// How wide the image is, in units of uv or of the shape's space, above 0.
    ///
    /// By uv it is as high as it is wide; by space its texels are square.
    pub size: f64,
    /// What it is laid along.
    pub by: TextureBy,
    /// What there is beyond its edges.
    pub wrap: Wrap,
    /// Whether a pixel gets a mean of what it covers, and what lies between texels is blended; without, the nearest texel.
    pub filter: bool,
}

impl Default for ImageTexture {
    fn default() -> Self {
        Self { file: String::new(), size: 1.0, by: TextureBy::Uv, wrap: Wrap::default(), filter: true }
    }
}
