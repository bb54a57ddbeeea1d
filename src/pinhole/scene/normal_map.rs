use super::{Feeds, Texture, UvTransform, Wrap};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On a material: a normal map in tangent space, as glTF 2.0 defines it, which tilts the shading normal from texel to
/// texel.
///
/// Red, green and blue from 0 to 1 stand for −1 to 1 to the right, along growing u; up, along falling v; and out of the
/// surface, so that (0.5, 0.5, 1) leaves the normal as it is.
/// The texels are taken as they are, without the sRGB curve, and interpolated bilinearly, without a mipmap.
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NormalMap {
    /// A .png, .jpg, .tga, .bmp, .hdr or .exr file of values from 0 to 1, blue more than a half; its path is relative to the
    /// scene file's folder, or to the current folder if there is no scene file.
    ///
    /// A grey image is a map of heights instead, white 1/50 of the image's width above black, and the normals are those of
    /// its slopes.
    pub file: String,
    /// The factor of the parts to the right and up: more makes the relief steeper, 0 leaves the normals as they are.
    pub scale: f64,
    /// The width and height of the image in units of uv, above 0; its upper left corner is at (0, 0).
    pub size: f64,
    /// The wrap mode beyond its edges.
    pub wrap: Wrap,
    /// How its coordinates are scaled, rotated and offset before it is looked up.
    pub transform: UvTransform,
}

impl Default for NormalMap {
    fn default() -> Self {
        Self { file: String::new(), scale: 1.0, size: 1.0, wrap: Wrap::default(), transform: UvTransform::default() }
    }
}

impl Texture for NormalMap {
    const WORD: &'static str = "normal map";
    const NOUN: &'static str = "normal map";
    const PATTERN: &'static str = "normal map";
    const FEEDS: Feeds = Feeds::Normal;
    fn is_filtered(&self) -> bool {
        false
    }
    fn file(&mut self) -> Option<&mut String> {
        Some(&mut self.file)
    }
}
