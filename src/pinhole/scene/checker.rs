use super::texture::scaled_by;
use super::{Feeds, Rgb, SceneError, Texture, TextureBy, positive_length};
use bevy_ecs::prelude::*;
use glam::DMat3;
use serde::{Deserialize, Serialize};

/// On a material: a checkerboard of two colours, in squares of uv or cubes of space, in place of the material's own
/// colour.
///
/// In uv a square begins at (0, 0); in space a cube of the first colour is centred on the shape's origin, so that no
/// planar shape lies on the boundary between two layers.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Checker {
    /// The first colour: an albedo, linear Rec. 709, each component from 0 to 1.
    pub first: Rgb,
    /// The second colour.
    pub second: Rgb,
    /// The edge length of a square or cube, in units of uv or of the shape's space, above 0.
    pub size: f64,
    /// The coordinates that it is evaluated at.
    pub by: TextureBy,
    /// Whether the texture is box-filtered over the pixel's footprint; if not, it is evaluated at one point.
    pub filter: bool,
}

impl Default for Checker {
    fn default() -> Self {
        let (first, second) = (Rgb::grey(0.8), Rgb::grey(0.2));
        Self { first, second, size: 1.0, by: TextureBy::default(), filter: true }
    }
}

impl Texture for Checker {
    const WORD: &'static str = "checker";
    const NOUN: &'static str = "checkered material";
    const PATTERN: &'static str = "checker";
    const FEEDS: Feeds = Feeds::Colour;
    fn by(&self) -> TextureBy {
        self.by
    }
    fn texture_from_surface(&self, who: &str) -> Result<DMat3, SceneError> {
        positive_length(who, "size", self.size).map(scaled_by)
    }
    fn is_filtered(&self) -> bool {
        self.filter
    }
}
