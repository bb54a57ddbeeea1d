use super::{TextureBy, Wrap};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On a material: the colours of an image file, in place of the material's own colour.
///
/// The image's lower left corner is at (0, 0), its x grows with the first coordinate, its y upward with the second.
/// By space the two are those of the shape's axes across which the surface faces: x and y on a side that faces ±z,
/// z and y on one that faces ±x, x and z on one that faces ±y; seen from outside, the image is never mirrored.
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ImageTexture {
    /// A .png, in sRGB, or a .hdr or .exr, in linear floats from 0 to 1; relative to the scene file's folder, or to the
    /// current one where there is no scene file.
    pub file: String,
    /// How wide the image is, in units of uv or of the shape's space, above 0.
    ///
    /// By uv it is as high as it is wide; by space as high as its pixels are square.
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
