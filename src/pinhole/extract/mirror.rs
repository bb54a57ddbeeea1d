use super::check::{kind_and_name, reflectance};
use super::material_kind::{
    MaterialKind, SMOOTHEST_METAL, in_use_of, material_entities, material_kind, material_kind_evidence,
};
use super::metal::metal_numbers;
use crate::plan::{Census, Evidence, Table};
use crate::scene::{Metal, Mirror, SceneError};
use bevy_ecs::prelude::*;

/// Perfect mirrors, in spawn order, including metal too smooth for its roughness to show.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MirrorTable {
    /// The reflectance of each: red, green, blue, from 0 to 1.
    pub colour: Vec<[f64; 3]>,
}

impl Table for MirrorTable {
    const NAME: &'static str = "mirrors";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for &entity in material_entities(scene).iter() {
            if material_kind(scene, entity) != Some(MaterialKind::Mirror) {
                continue;
            }
            table.colour.push(match scene.get::<Mirror>(entity) {
                Some(mirror) => {
                    reflectance(&kind_and_name(scene, "mirror", entity), "colour", mirror.colour)?.to_array()
                }
                None => metal_numbers(scene, entity)?.0,
            });
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.colour.len() * size_of::<[f64; 3]>()
    }
}

/// Evidence of a perfect mirror, either a Mirror or metal smooth enough to be one.
pub fn mirror_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| {
        let mirror = material_kind_evidence::<Mirror>(scene, "mirror");
        let smooth = in_use_of::<Metal>(scene, "smooth metal", |metal| metal.roughness < SMOOTHEST_METAL);
        if smooth.needed { mirror.or(smooth) } else { mirror }
    })
}
