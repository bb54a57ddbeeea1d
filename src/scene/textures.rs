//! Textures: what a texture is, the list of them, and their components.

use super::{Degrees, FileKind, Rgb, SceneError, number, positive_length, triple};
use bevy_ecs::component::Mutable;
use bevy_ecs::prelude::*;
use glam::{DMat2, DMat3, DVec2, DVec3};
use serde::{Deserialize, Serialize};

/// All textures; a further one is a line here.
// ANCHOR: texture_list
#[doc(hidden)]
#[macro_export]
macro_rules! for_each_texture {
    ($then:ident) => {
        $then! { Checker, Stripes, ImageTexture, NormalMap, MetallicRoughnessMap, EmissionMap, OpacityMap }
    };
}
// ANCHOR_END: texture_list

macro_rules! texture_files {
    ($($texture:ident),+) => {
        /// The names of the images of an entity's textures.
        pub(super) fn texture_files(entity: EntityRef<'_>) -> Vec<String> {
            let files = [$(entity.get::<$texture>().and_then(|texture| texture.clone().file().cloned())),+];
            files.into_iter().flatten().collect()
        }

        /// Calls a function with the name of each image of a scene's textures, which it may change.
        pub(super) fn change_texture_files(scene: &mut World, change: &mut impl FnMut(&mut String)) {
            $(for mut texture in scene.query::<&mut $texture>().iter_mut(scene) {
                texture.file().into_iter().for_each(&mut *change);
            })+
        }
    };
}
for_each_texture!(texture_files);

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

/// Makes an image over uv a texture: its name, what it gives, and whether it is filtered.
macro_rules! over_uv {
    ($map:ty, $name:literal, $feeds:ident, $is_filtered:expr) => {
        impl Texture for $map {
            const WORD: &'static str = $name;
            const NOUN: &'static str = $name;
            const PATTERN: &'static str = $name;
            const FEEDS: Feeds = Feeds::$feeds;
            fn is_filtered(&self) -> bool {
                let is_filtered: fn(&Self) -> bool = $is_filtered;
                is_filtered(self)
            }
            fn file(&mut self) -> Option<&mut String> {
                Some(&mut self.file)
            }
        }
    };
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

over_uv!(NormalMap, "normal map", Normal, |_| false);

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

over_uv!(MetallicRoughnessMap, "metallic–roughness map", MetallicRoughness, |map| map.filter);

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

over_uv!(EmissionMap, "emission map", Emission, |map| map.filter);

/// On a material that transmits no light itself: the probability that a ray hits it; otherwise the ray goes straight on.
///
/// Such a surface is like a fabric, with gaps between its threads that are too small to be seen.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Opacity {
    /// The fraction of the surface that is covered, from 0 to 1; a factor of an [`OpacityMap`].
    pub opacity: f64,
    /// Whether each point is opaque or not there at all, by whether its opacity is at least `cutoff`.
    pub mask: bool,
    /// The lowest opacity of an opaque point of a mask, at least 0.
    pub cutoff: f64,
}

impl Default for Opacity {
    fn default() -> Self {
        Self { opacity: 1.0, mask: false, cutoff: 0.5 }
    }
}

impl Opacity {
    /// The opacity of a point, at which an image has this one.
    #[inline(always)]
    pub fn with(&self, map: f64) -> f64 {
        let opacity = self.opacity * map;
        if self.mask { f64::from(u8::from(opacity >= self.cutoff)) } else { opacity }
    }
}

/// A channel of an image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum OpacityChannel {
    /// Alpha; 1 where the image has none.
    #[default]
    Alpha,
    /// Red, which a grey image has, too.
    Red,
}

/// On a material: an image of its opacity, a factor of that of its [`Opacity`].
#[derive(Component, Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct OpacityMap {
    /// An image file, whose numbers are taken as they are in it, from 0 to 1; its path is relative to the scene file's folder,
    /// or to the current folder if there is no scene file.
    pub file: String,
    /// Which of its channels the opacity is.
    pub channel: OpacityChannel,
    /// The width and height of the image in units of uv, above 0; its upper left corner is at (0, 0).
    pub size: f64,
    /// The wrap mode beyond its edges.
    pub wrap: Wrap,
    /// How its coordinates are scaled, rotated and offset before it is looked up.
    pub transform: UvTransform,
    /// Whether it is interpolated between texels; if not, the nearest texel is taken.
    pub filter: bool,
}

impl Default for OpacityMap {
    fn default() -> Self {
        Self {
            file: String::new(),
            channel: OpacityChannel::default(),
            size: 1.0,
            wrap: Wrap::default(),
            transform: UvTransform::default(),
            filter: true,
        }
    }
}

// Rays decide at points, and many samples of them filter.
over_uv!(OpacityMap, "opacity map", Opacity, |_| false);

/// On a material that transmits no light: rays that arrive from behind go straight on, as if the surface were not there.
///
/// The front is the side of the shape's own normal, from which a triangle's corners run anticlockwise.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SingleSided {}

/// Factors by which the colour of a material is multiplied, that of its texture included; model files give them.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tint {
    /// By which the colour of the material or of its texture is multiplied, each part from 0 to 1.
    pub factor: Rgb,
    /// Whether the colours of a mesh's vertices are a factor, too.
    pub by_vertex: bool,
}

impl Default for Tint {
    /// Changes nothing.
    fn default() -> Self {
        Self { factor: Rgb::grey(1.0), by_vertex: false }
    }
}
