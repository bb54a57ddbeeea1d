use super::{Feeds, Rgb, SceneError, Texture, TextureBy, positive_length, triple};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

/// On a material: stripes of two colours, alternating along one direction, in place of the material's own colour.
///
/// In uv the first stripe begins at (0, 0); in space it is centred on the shape's origin.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Stripes {
    /// The first colour: an albedo, linear Rec. 709, each component from 0 to 1.
    pub first: Rgb,
    /// The second colour.
    pub second: Rgb,
    /// The width of a stripe, in units of uv or of the shape's space, above 0.
    pub size: f64,
    /// The direction across the stripes, of any length but 0; in uv only its x and y count, along u and v.
    pub across: DVec3,
    /// The coordinates that they are evaluated at.
    pub by: TextureBy,
    /// Whether the texture is box-filtered over the pixel's footprint; if not, it is evaluated at one point.
    pub filter: bool,
}

impl Default for Stripes {
    fn default() -> Self {
        let (first, second) = (Rgb::grey(0.8), Rgb::grey(0.2));
        Self { first, second, size: 1.0, across: DVec3::X, by: TextureBy::default(), filter: true }
    }
}

impl Texture for Stripes {
    const WORD: &'static str = "stripes";
    const NOUN: &'static str = "striped material";
    const PATTERN: &'static str = "stripe pattern";
    const FEEDS: Feeds = Feeds::Colour;
    fn by(&self) -> TextureBy {
        self.by
    }
    fn texture_from_surface(&self, who: &str) -> Result<DMat3, SceneError> {
        let size = positive_length(who, "size", self.size)?;
        let mut across = self.across;
        if self.by == TextureBy::Uv {
            across.z = 0.0;
        }
        let longest = across.abs().max_element();
        if !(longest > 0.0 && across.is_finite()) {
            let accepted = match self.by {
                TextureBy::Uv => "its x and y, along u and v, must be a finite direction other than 0",
                TextureBy::Space => "it must be a finite direction other than 0",
            };
            return Err(SceneError::new(who, "across", triple(self.across), accepted));
        }
        let row = (across / longest).normalize() / size;
        Ok(DMat3::from_cols(row, DVec3::ZERO, DVec3::ZERO).transpose())
    }
    fn is_filtered(&self) -> bool {
        self.filter
    }
}
