use super::MaterialKind;
use super::check::{kind_and_name, number, reflectance};
use super::material::{in_use_of, material_entities, material_kind};
use crate::plan::{Evidence, Table};
use crate::scene::{Metal, SceneError};
use bevy_ecs::prelude::*;

/// The least α of a rough metal; below it, metal is a perfect mirror.
///
/// There its highlight falls to one half within 0.07° of its centre.
pub const SMOOTHEST_METAL: f64 = 1e-3;

/// Rough metals, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MetalTable {
    /// The reflectance of each metal's microfacets: red, green, blue, from 0 to 1.
    pub colour: Vec<[f64; 3]>,
    /// GGX's α, from 0.001 to 1.
    pub alpha: Vec<f64>,
}

impl Table for MetalTable {
    const NAME: &'static str = "metals";

    fn extract(scene: &World) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for entity in material_entities(scene) {
            if material_kind(scene, entity) == Some(MaterialKind::Metal) {
                let (colour, alpha) = metal_numbers(scene, entity)?;
                table.colour.push(colour);
                table.alpha.push(alpha);
            }
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.alpha.len() * size_of::<[f64; 4]>()
    }
}

/// A metal's colour and roughness, checked.
pub(super) fn metal_numbers(scene: &World, entity: Entity) -> Result<([f64; 3], f64), SceneError> {
    let metal = scene.get::<Metal>(entity).copied().unwrap_or_default();
    let who = kind_and_name(scene, "metal", entity);
    let colour = reflectance(&who, "colour", metal.colour)?.to_array();
    if (0.0..=1.0).contains(&metal.roughness) {
        Ok((colour, metal.roughness))
    } else {
        Err(SceneError::new(who, "roughness", number(metal.roughness), "it must be a number from 0 to 1"))
    }
}

/// Checks a metal's values; its diffuse colour is black.
pub(super) fn metal_colour(scene: &World, entity: Entity, _who: &str) -> Result<[f64; 3], SceneError> {
    metal_numbers(scene, entity).map(|_| [0.0; 3])
}

/// The kind of a metal: a perfect mirror where it is smooth enough.
pub(super) fn metal_kind(scene: &World, entity: Entity) -> MaterialKind {
    let smooth = scene.get::<Metal>(entity).is_some_and(|metal| metal.roughness < SMOOTHEST_METAL);
    if smooth { MaterialKind::Mirror } else { MaterialKind::Metal }
}

/// For each row of [`MetalTable`], whether it models multiple scattering between microfacets.
pub fn multiple_scattering_metals(scene: &World) -> Vec<bool> {
    let rough = material_entities(scene).into_iter();
    let rough = rough.filter(|&entity| material_kind(scene, entity) == Some(MaterialKind::Metal));
    rough.map(|entity| scene.get::<Metal>(entity).is_some_and(|metal| metal.multiple_scattering)).collect()
}

/// Evidence of multiple scattering between microfacets.
pub fn multiple_scattering_evidence(scene: &World) -> Evidence {
    in_use_of::<Metal>(scene, "rough metal of multiple scattering", |metal| {
        metal.multiple_scattering && !matches!(metal.roughness, ..SMOOTHEST_METAL)
    })
}

/// Evidence of a shape made of rough metal.
pub fn metal_evidence(scene: &World) -> Evidence {
    // NaN counts too, so that it is reported and not overlooked.
    in_use_of::<Metal>(scene, "rough metal", |metal| !matches!(metal.roughness, ..SMOOTHEST_METAL))
}
