//! A texture: the rings of a tree about an entity's own y.

use pinhole::extend::*;
use pinhole::prelude::*;

/// Two kinds of wood, ring after ring.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct Rings {
    /// The wood of spring.
    pub light: Rgb,
    /// The wood of summer.
    pub dark: Rgb,
    /// How wide a year is.
    pub width: f64,
}

impl Default for Rings {
    fn default() -> Self {
        Self { light: Rgb::new(0.7, 0.5, 0.3), dark: Rgb::new(0.4, 0.22, 0.1), width: 0.3 }
    }
}

impl Texture for Rings {
    const WORD: &'static str = "rings";
    const NOUN: &'static str = "material with rings";
    const PATTERN: &'static str = "pattern of rings";
    const FEEDS: Feeds = Feeds::Colour;

    fn by(&self) -> TextureBy {
        TextureBy::Space
    }

    fn is_filtered(&self) -> bool {
        false
    }

    fn texture_from_surface(&self, who: &str) -> Result<DMat3, SceneError> {
        if !(self.width > 0.0 && self.width.is_finite()) {
            return Err(SceneError::new(who, "width", self.width, "it must be finite and above 0"));
        }
        Ok(DMat3::from_diagonal(DVec3::splat(1.0 / self.width)))
    }
}

impl Pattern for Rings {
    const TABLE: &'static str = "rings";
    const STAGE: &'static str = "Evaluate textures: rings";

    fn albedos(&self) -> Vec<(&'static str, Rgb)> {
        vec![("light", self.light), ("dark", self.dark)]
    }

    fn colour(&self, at: &TexturePoint) -> [f64; 3] {
        let years = libm::hypot(at.point.x, at.point.z);
        let dark = years.fract() * years.fract();
        let mixed = |one: f64, other: f64| one + dark * (other - one);
        let (light, own) = (self.light, self.dark);
        [mixed(light.r, own.r), mixed(light.g, own.g), mixed(light.b, own.b)]
    }
}
