use super::texture::scaled_by;
use super::{Feeds, FileKind, SceneError, Texture, TextureBy, UvTransform, Wrap, positive_length};
use bevy_ecs::prelude::*;
use glam::DMat3;
use serde::{Deserialize, Serialize};

/// The kind of file that a texture or an environment names.
pub const IMAGE_FILE: FileKind = FileKind { name: "an image", max: 1 << 30 };

/// On a material: an image texture, in place of the material's own colour.
///
/// In uv its upper left corner is at (0, 0), its x grows with u, and its y, downward, with v.
/// In space it is centred on the shape's origin and projected along the axis that the surface faces most, as onto the
/// faces of a cuboid: upright on faces towards x or z, and never mirrored when seen from outside.
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ImageTexture {
    /// A .png, .jpg, .tga or .bmp file in sRGB, or a .hdr or .exr of linear values from 0 to 1; its path is relative to the
    /// scene file's folder, or to the current folder if there is no scene file.
    pub file: String,
    /// The width of the image, in units of uv or of the shape's space, above 0.
    ///
    /// In uv it is as high as it is wide; in space its texels are square.
    pub size: f64,
    /// The coordinates that it is evaluated at.
    pub by: TextureBy,
    /// The wrap mode beyond its edges.
    pub wrap: Wrap,
    /// How its coordinates are scaled, rotated and offset before it is looked up.
    pub transform: UvTransform,
    /// Whether it is filtered: bilinearly between texels, and over the pixel's footprint by mipmapping; if not, the
    /// nearest texel is taken.
    pub filter: bool,
}

impl Default for ImageTexture {
    fn default() -> Self {
        Self {
            file: String::new(),
            size: 1.0,
            by: TextureBy::Uv,
            wrap: Wrap::default(),
            transform: UvTransform::default(),
            filter: true,
        }
    }
}

impl Texture for ImageTexture {
    const WORD: &'static str = "image texture";
    const NOUN: &'static str = "image texture";
    const PATTERN: &'static str = "image";
    const FEEDS: Feeds = Feeds::Colour;
    const ON_FACES: bool = true;
    fn by(&self) -> TextureBy {
        self.by
    }
    fn texture_from_surface(&self, who: &str) -> Result<DMat3, SceneError> {
        positive_length(who, "size", self.size).map(scaled_by)
    }
    fn is_filtered(&self) -> bool {
        self.filter
    }
    fn file(&mut self) -> Option<&mut String> {
        Some(&mut self.file)
    }
}
