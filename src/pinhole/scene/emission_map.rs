use super::{Feeds, Texture, UvTransform, Wrap};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// Beside an [`Emissive`](super::Emissive): an image of what the surface emits, a factor of its radiance.
///
/// Light sampling does not sample a surface with such an image; BSDF sampling finds its light.
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct EmissionMap {
    /// A .png, .jpg, .tga or .bmp file in sRGB, or a .hdr or .exr of linear values, finite and at least 0; its path is relative to the
    /// scene file's folder, or to the current folder if there is no scene file.
    pub file: String,
    /// The width and height of the image in units of uv, above 0; its upper left corner is at (0, 0).
    pub size: f64,
    /// The wrap mode beyond its edges.
    pub wrap: Wrap,
    /// How its coordinates are scaled, rotated and offset before it is looked up.
    pub transform: UvTransform,
    /// Whether it is filtered: bilinearly between texels, and over the pixel's footprint by mipmapping; if not, the
    /// nearest texel is taken.
    pub filter: bool,
}

impl Default for EmissionMap {
    fn default() -> Self {
        Self { file: String::new(), size: 1.0, wrap: Wrap::default(), transform: UvTransform::default(), filter: true }
    }
}

impl Texture for EmissionMap {
    const WORD: &'static str = "emission map";
    const NOUN: &'static str = "emission map";
    const PATTERN: &'static str = "emission map";
    const FEEDS: Feeds = Feeds::Emission;
    fn is_filtered(&self) -> bool {
        self.filter
    }
    fn file(&mut self) -> Option<&mut String> {
        Some(&mut self.file)
    }
}
