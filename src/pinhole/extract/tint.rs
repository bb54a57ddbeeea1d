use super::check::{kind_and_name, reflectance};
use super::material::material_kind_evidence;
use super::texture::{NO_TEXTURE, check_owner, rows_of_texture, texture_evidence};
use crate::plan::{Census, Evidence, Table};
use crate::scene::{Feeds, MeshInstance, SceneError, Tint};
use bevy_ecs::prelude::*;

/// The tints of materials, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TintTable {
    /// The row of each material's tint; [`NO_TEXTURE`] where it has none.
    pub of_material: Vec<u32>,
    /// The factor of the colour.
    pub factor: Vec<[f64; 3]>,
    /// Whether the colours of a mesh's vertices are a factor, too.
    pub by_vertex: Vec<bool>,
}

impl TintTable {
    /// The row of a material's tint, if it has one.
    #[inline(always)]
    pub fn row_of(&self, material: usize) -> Option<usize> {
        let row = self.of_material[material];
        (row != NO_TEXTURE).then_some(row as usize)
    }
}

impl Table for TintTable {
    const NAME: &'static str = "tints";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (of_material, rows) = rows_of_texture::<Tint>(scene);
        let mut table = Self { of_material, ..Self::default() };
        for &owner in scene.entities::<With<Tint>>().iter() {
            check_owner(scene, ("tint", owner), (Feeds::Colour, "a tint multiplies the colour of diffuse reflection"))?;
        }
        for material in rows {
            let Some(tint) = scene.get::<Tint>(material) else { continue };
            let who = kind_and_name(scene, "tint", material);
            table.factor.push(reflectance(&who, "factor", tint.factor)?.to_array());
            table.by_vertex.push(tint.by_vertex);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.of_material.len() * 4 + self.factor.len() * (size_of::<[f64; 3]>() + size_of::<bool>())
    }
}

/// Evidence that a shape is made of a material with a tint.
pub fn tint_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| material_kind_evidence::<Tint>(scene, "tinted material"))
}

/// Evidence that a surface's colour is not that of its material everywhere.
pub fn surface_colour_evidence(scene: &Census<'_>) -> Evidence {
    let tint = tint_evidence(scene);
    let texture = texture_evidence(scene);
    if tint.needed { texture.or(tint) } else { texture }
}

/// Evidence that a mesh has colours of its vertices, and a material is tinted.
pub fn vertex_colour_evidence(scene: &Census<'_>) -> Evidence {
    let has = |mesh| scene.get::<MeshInstance>(mesh).is_some_and(|mesh| mesh.geometry.colours.is_some());
    tint_evidence(scene).and(|| Evidence::of_kind::<With<MeshInstance>>(scene, "mesh with colours", has))
}
