use super::check::{kind_and_name, reflectance, triple};
use super::texture::{check_beside_colour, rows_of_kind};
use crate::plan::{Census, Table};
use crate::scene::{Checker, Rgb, SceneError, Stripes, Texture};
use bevy_ecs::prelude::*;

/// Textures of one kind that consist of two colours, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TwoColours {
    /// The row of each material's texture; [`NO_TEXTURE`](super::NO_TEXTURE) where it has none of this kind.
    pub of_material: Vec<u32>,
    /// The first colour, an albedo from 0 to 1.
    pub first: Vec<[f64; 3]>,
    /// The second colour.
    pub second: Vec<[f64; 3]>,
    /// Whether each is filtered over a pixel's footprint.
    pub filter: Vec<bool>,
}

impl TwoColours {
    fn of<T: Texture>(scene: &Census<'_>, colours: impl Fn(&T) -> (Rgb, Rgb)) -> Result<Self, SceneError> {
        let (of_material, rows) = rows_of_kind::<T>(scene);
        let mut table = Self { of_material, ..Self::default() };
        for material in rows {
            let Some(texture) = scene.get::<T>(material) else { continue };
            let who = kind_and_name(scene, T::WORD, material);
            let (first, second) = colours(texture);
            for (field, colour, colours) in [("first", first, &mut table.first), ("second", second, &mut table.second)]
            {
                colours.push(reflectance(&who, field, colour)?.to_array());
                check_beside_colour(scene, material, (&who, field, triple(colour.to_vec())), colour)?;
            }
            table.filter.push(texture.is_filtered());
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.of_material.len() * 4 + self.first.len() * (2 * size_of::<[f64; 3]>() + size_of::<bool>())
    }
}

/// The checker textures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CheckerTable(pub TwoColours);

/// The stripe textures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StripesTable(pub TwoColours);

impl Table for CheckerTable {
    const NAME: &'static str = "checkers";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        TwoColours::of::<Checker>(scene, |checker| (checker.first, checker.second)).map(Self)
    }

    fn bytes(&self) -> usize {
        self.0.bytes()
    }
}

impl Table for StripesTable {
    const NAME: &'static str = "stripes";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        TwoColours::of::<Stripes>(scene, |stripes| (stripes.first, stripes.second)).map(Self)
    }

    fn bytes(&self) -> usize {
        self.0.bytes()
    }
}
