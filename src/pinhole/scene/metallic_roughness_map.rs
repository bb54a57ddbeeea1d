use super::{Feeds, Texture, UvTransform, Wrap};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On a [`Principled`](super::Principled) material: an image of its metallic and its roughness, as glTF 2.0 defines it,
/// each a factor of the material's own number.
///
/// Green is the perceived roughness and blue the metallic; red is not used.
/// The texels are taken as they are, without the sRGB curve.
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MetallicRoughnessMap {
    /// A .png, .jpg, .tga, .bmp, .hdr or .exr file of values from 0 to 1; its path is relative to the scene file's folder, or to the
    /// current folder if there is no scene file.
    pub file: String,
    /// The width and height of the image in units of uv, above 0; its upper left corner is at (0, 0).
    pub size: f64,
    /// The wrap mode beyond its edges.
    pub wrap: Wrap,
    /// How its coordinates are scaled, rotated and offset before it is looked up.
    pub transform: UvTransform,
    /// Whether it is filtered: bilinearly between texels, and over the pixel's footprint by mipmapping; if not, the
    /// nearest texel is taken.
    ///
    /// The mean of roughnesses is an approximation: two highlights of different widths, seen together, are not one of
    /// the width in between.
    pub filter: bool,
}

impl Default for MetallicRoughnessMap {
    fn default() -> Self {
        Self { file: String::new(), size: 1.0, wrap: Wrap::default(), transform: UvTransform::default(), filter: true }
    }
}

impl Texture for MetallicRoughnessMap {
    const WORD: &'static str = "metallic–roughness map";
    const NOUN: &'static str = "metallic–roughness map";
    const PATTERN: &'static str = "metallic–roughness map";
    const FEEDS: Feeds = Feeds::MetallicRoughness;
    fn is_filtered(&self) -> bool {
        self.filter
    }
    fn file(&mut self) -> Option<&mut String> {
        Some(&mut self.file)
    }
}
