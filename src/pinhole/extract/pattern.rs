use super::check::{kind_and_name, reflectance, triple};
use super::texture::{check_beside_colour, rows_of_texture};
use crate::plan::{Census, Table, check_is_added};
use crate::scene::{Checker, Rgb, SceneError, Stripes, Texture};
use glam::DVec3;
use std::fmt::Debug;

/// A point on a surface in the coordinates of its texture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TexturePoint {
    /// The texture coordinates, in units of the texture.
    pub point: DVec3,
    /// The pixel's offsets to the right and down.
    pub steps: [DVec3; 2],
}

impl TexturePoint {
    /// The same point without a footprint.
    #[inline(always)]
    pub fn alone(self) -> Self {
        Self { steps: [DVec3::ZERO; 2], ..self }
    }
}

/// A texture of colours that a formula gives, in place of the material's own.
pub trait Pattern: Texture + Clone + Debug + PartialEq {
    /// The name of its table, such as `checkers`.
    const TABLE: &'static str;
    /// The name of its stage, such as `Evaluate textures: checkers`.
    const STAGE: &'static str;
    /// Whether a program adds it.
    const IS_CUSTOM: bool = true;
    /// Albedos that none of its colours exceeds, by the names of their fields.
    fn albedos(&self) -> Vec<(&'static str, Rgb)>;
    /// The colour at a point: its mean over the pixel's footprint, which is 0 wide where it is not filtered.
    fn colour(&self, at: &TexturePoint) -> [f64; 3];
}

/// The textures of one kind that a formula gives, in spawn order.
#[derive(Clone, Debug, PartialEq)]
pub struct PatternTable<T> {
    /// The row of each material's texture; [`NO_TEXTURE`](super::NO_TEXTURE) where it has none of this kind.
    pub of_material: Vec<u32>,
    /// The textures.
    pub pattern: Vec<T>,
}

/// The checker textures.
pub type CheckerTable = PatternTable<Checker>;
/// The stripe textures.
pub type StripesTable = PatternTable<Stripes>;

impl<T: Pattern> Table for PatternTable<T> {
    const NAME: &'static str = T::TABLE;

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        if T::IS_CUSTOM {
            check_is_added::<Self>(scene, T::WORD, "add_texture")?;
        }
        let (of_material, rows) = rows_of_texture::<T>(scene);
        let mut table = Self { of_material, pattern: Vec::new() };
        for material in rows {
            let Some(pattern) = scene.get::<T>(material) else { continue };
            let who = kind_and_name(scene, T::WORD, material);
            for (field, colour) in pattern.albedos() {
                reflectance(&who, field, colour)?;
                check_beside_colour(scene, material, (&who, field, triple(colour.to_vec())), colour)?;
            }
            table.pattern.push(pattern.clone());
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.of_material[..]) + size_of_val(&self.pattern[..])
    }
}
