use super::{Degrees, SceneError, number};
use bevy_ecs::component::Mutable;
use bevy_ecs::prelude::*;
use glam::{DMat2, DMat3, DVec2, DVec3};
use serde::{Deserialize, Serialize};

/// What a texture gives a surface, in place of what its material or its emission has everywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feeds {
    /// The colour, as of diffuse reflection.
    Colour,
    /// The metallic and the roughness.
    MetallicRoughness,
    /// The shading normal.
    Normal,
    /// A factor of the emission.
    Emission,
    /// A factor of the opacity.
    Opacity,
}

/// A texture: a component beside a material, or beside an emission, that changes something of the surface from point to
/// point.
pub trait Texture: Component<Mutability = Mutable> {
    /// Its name in messages.
    const WORD: &'static str;
    /// What has it, in the plan's counts.
    const NOUN: &'static str;
    /// One such pattern, in the plan's counts.
    const PATTERN: &'static str;
    /// What it gives.
    const FEEDS: Feeds;
    /// The coordinates that it is evaluated at.
    fn by(&self) -> TextureBy {
        TextureBy::Uv
    }
    /// Whether in space it is projected along the axis that the surface faces most.
    const ON_FACES: bool = false;
    /// The linear map from these to its own coordinates, in which its pattern repeats by whole numbers.
    ///
    /// Errors: a value that is not accepted.
    fn texture_from_surface(&self, _who: &str) -> Result<DMat3, SceneError> {
        Ok(DMat3::IDENTITY)
    }
    /// Whether it is filtered over a pixel's footprint.
    fn is_filtered(&self) -> bool;
    /// The file of its image, if it has one.
    fn file(&mut self) -> Option<&mut String> {
        None
    }
}

/// The map to the coordinates of a texture whose pattern has this size.
pub(super) fn scaled_by(size: f64) -> DMat3 {
    DMat3::from_diagonal(DVec3::splat(1.0 / size))
}

/// The coordinates at which a texture is evaluated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum TextureBy {
    /// The surface's own parameters u and v: the pattern follows the surface.
    Uv,
    /// Object space (a solid texture): the shape is carved out of the pattern, which moves, rotates and scales with it.
    #[default]
    Space,
}

/// How an image texture continues beyond its edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Wrap {
    /// The image is repeated.
    #[default]
    Repeat,
    /// The texels at the edge are extended.
    Clamp,
    /// The image is repeated, and every second one is mirrored.
    Mirror,
    /// Along u it continues in another way than along v.
    PerAxis {
        /// Beyond the left and the right edge.
        u: WrapMode,
        /// Beyond the upper and the lower edge.
        v: WrapMode,
    },
}

/// How an image texture continues beyond two opposite edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum WrapMode {
    /// The image is repeated.
    #[default]
    Repeat,
    /// The texels at the edge are extended.
    Clamp,
    /// The image is repeated, and every second one is mirrored.
    Mirror,
}

impl Wrap {
    /// The wrap modes along u and along v.
    pub fn axes(self) -> [WrapMode; 2] {
        match self {
            Self::Repeat => [WrapMode::Repeat; 2],
            Self::Clamp => [WrapMode::Clamp; 2],
            Self::Mirror => [WrapMode::Mirror; 2],
            Self::PerAxis { u, v } => [u, v],
        }
    }
}

impl From<[WrapMode; 2]> for Wrap {
    /// One word where both axes wrap alike.
    fn from([u, v]: [WrapMode; 2]) -> Self {
        match [u, v] {
            [WrapMode::Repeat, WrapMode::Repeat] => Self::Repeat,
            [WrapMode::Clamp, WrapMode::Clamp] => Self::Clamp,
            [WrapMode::Mirror, WrapMode::Mirror] => Self::Mirror,
            _ => Self::PerAxis { u, v },
        }
    }
}

/// An affine map of texture coordinates, applied to those of the surface before the image is looked up: they are scaled,
/// then rotated about the origin, then offset, as glTF's `KHR_texture_transform` does it.
///
/// All of it is in units of the image, whose upper left corner is at (0, 0): a scale of 2 makes the image half as large.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct UvTransform {
    /// Added last: 0.5 shifts the image to the left, or up, by half of its own size.
    pub offset: DVec2,
    /// The rotation of the coordinates, anticlockwise as one sees the image, which itself appears to rotate clockwise.
    pub rotation: Degrees,
    /// The factors of u and v; how often the image is repeated.
    pub scale: DVec2,
}

impl Default for UvTransform {
    fn default() -> Self {
        Self { offset: DVec2::ZERO, rotation: Degrees(0.0), scale: DVec2::ONE }
    }
}

impl UvTransform {
    /// Its matrix and its offset; nothing where it leaves the coordinates as they are.
    ///
    /// Errors: a number that is not finite.
    pub fn affine(&self, who: &str) -> Result<Option<(DMat2, DVec2)>, SceneError> {
        if *self == Self::default() {
            return Ok(None);
        }
        let Self { offset, rotation, scale } = *self;
        let refused = |field, value: String| Err(SceneError::new(who, field, value, "its numbers must be finite"));
        let pair = |v: DVec2| format!("({}, {})", number(v.x), number(v.y));
        match () {
            () if !offset.is_finite() => return refused("offset", pair(offset)),
            () if !rotation.0.is_finite() => return refused("rotation", number(rotation.0)),
            () if !scale.is_finite() => return refused("scale", pair(scale)),
            () => {}
        }
        let (sine, cosine) = libm::sincos(rotation.radians());
        let rotated = DMat2::from_cols(DVec2::new(cosine, -sine), DVec2::new(sine, cosine));
        Ok(Some((rotated * DMat2::from_diagonal(scale), offset)))
    }
}
