use super::{Feeds, Texture, UvTransform, Wrap};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

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

impl Texture for OpacityMap {
    const WORD: &'static str = "opacity map";
    const NOUN: &'static str = "opacity map";
    const PATTERN: &'static str = "opacity map";
    const FEEDS: Feeds = Feeds::Opacity;
    /// Rays decide at points, and many samples of them filter.
    fn is_filtered(&self) -> bool {
        false
    }
    fn file(&mut self) -> Option<&mut String> {
        Some(&mut self.file)
    }
}

/// On a material that transmits no light: rays that arrive from behind go straight on, as if the surface were not there.
///
/// The front is the side of the shape's own normal, from which a triangle's corners run anticlockwise.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SingleSided {}
