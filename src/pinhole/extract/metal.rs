use super::check::{kind_and_name, number, reflectance};
use super::material_kind::{MaterialKind, SMOOTHEST_METAL, in_use_of, material_entities, material_kind};
use crate::plan::{Census, Evidence, Table};
use crate::scene::{Metal, SceneError};
use bevy_ecs::prelude::*;

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

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for &entity in material_entities(scene).iter() {
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
pub(super) fn metal_numbers(scene: &Census<'_>, entity: Entity) -> Result<([f64; 3], f64), SceneError> {
    let metal = scene.get::<Metal>(entity).copied().unwrap_or_default();
    let who = kind_and_name(scene, "metal", entity);
    let colour = reflectance(&who, "colour", metal.colour)?.to_array();
    if (0.0..=1.0).contains(&metal.roughness) {
        Ok((colour, metal.roughness))
    } else {
        Err(SceneError::new(who, "roughness", number(metal.roughness), "it must be a number from 0 to 1"))
    }
}

/// For each row of [`MetalTable`], whether it models multiple scattering between microfacets.
pub fn multiple_scattering_metals(scene: &Census<'_>) -> Vec<bool> {
    let materials = material_entities(scene);
    let rough = materials.iter().copied().filter(|&entity| material_kind(scene, entity) == Some(MaterialKind::Metal));
    rough.map(|entity| scene.get::<Metal>(entity).is_some_and(|metal| metal.multiple_scattering)).collect()
}

/// Evidence of multiple scattering between microfacets.
pub fn multiple_scattering_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| {
        in_use_of::<Metal>(scene, "rough metal of multiple scattering", |metal| {
            metal.multiple_scattering && !matches!(metal.roughness, ..SMOOTHEST_METAL)
        })
    })
}

/// Evidence of a shape made of rough metal.
pub fn metal_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| {
        // NaN counts too, so that it is reported and not overlooked.
        in_use_of::<Metal>(scene, "rough metal", |metal| !matches!(metal.roughness, ..SMOOTHEST_METAL))
    })
}
