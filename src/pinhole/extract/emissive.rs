use super::check::{kind_and_name, light_colour};
use super::material::material_kind_evidence;
use super::non_opaque::is_non_opaque;
use crate::plan::{Census, Evidence, Table};
use crate::scene::{Disabled, EmissionMap, Emissive, SceneError, Sides, UsesMaterial};
use bevy_ecs::prelude::*;
use std::sync::Arc;

/// The emission of surfaces, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EmissiveTable {
    /// The radiance emitted at every point, linear Rec. 709.
    pub radiance: Vec<[f32; 3]>,
    /// Whether it is emitted only on the side of the shape's own normal.
    pub one_sided: Vec<bool>,
    /// Whether it is not the same at every point, because an image gives it or the surface is not opaque, so that light
    /// sampling leaves it to BSDF sampling; empty where it is for all.
    pub mapped: Vec<bool>,
}

/// The enabled entities that carry an [`Emissive`], in spawn order, one for each row of the table.
pub(super) fn emissive_entities(scene: &Census<'_>) -> Arc<[Entity]> {
    scene.entities::<With<Emissive>>()
}

/// The entity that holds a shape's emission: itself, or else the one whose material it uses.
pub(super) fn emissive_of(scene: &Census<'_>, shape: Entity) -> Option<Entity> {
    let used = scene.get::<UsesMaterial>(shape).map(|used| used.0);
    let emits = |entity: &Entity| scene.get::<Emissive>(*entity).is_some() && scene.get::<Disabled>(*entity).is_none();
    [Some(shape), used].into_iter().flatten().find(emits)
}

/// Whether a shape's emission is not the same at every point: an image gives it, or the surface is not opaque.
pub(super) fn is_emission_mapped(scene: &Census<'_>, shape: Entity) -> bool {
    is_non_opaque(scene)(shape)
        || emissive_of(scene, shape).is_some_and(|emissive| scene.get::<EmissionMap>(emissive).is_some())
}

impl Table for EmissiveTable {
    const NAME: &'static str = "emissive surfaces";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (mut table, is_non_opaque) = (Self::default(), is_non_opaque(scene));
        for &entity in emissive_entities(scene).iter() {
            let emissive = scene.get::<Emissive>(entity).copied().unwrap_or_default();
            let who = kind_and_name(scene, "emissive", entity);
            let radiance = light_colour(&who, "radiance", emissive.radiance)?.to_array();
            table.radiance.push(radiance.map(|part| part as f32));
            table.one_sided.push(emissive.sides == Sides::Front);
            table.mapped.push(scene.get::<EmissionMap>(entity).is_some() || is_non_opaque(entity));
        }
        if !table.mapped.contains(&true) {
            table.mapped.clear();
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.radiance.len() * (size_of::<[f32; 3]>() + size_of::<bool>()) + self.mapped.len()
    }
}

/// Evidence that a shape emits light on one of its sides only.
pub fn one_sided_evidence(scene: &Census<'_>) -> Evidence {
    let one_sided = |entity: &Entity| scene.get::<Emissive>(*entity).is_some_and(|own| own.sides == Sides::Front);
    let found = emissive_evidence(scene);
    if found.needed && emissive_entities(scene).iter().any(one_sided) {
        return Evidence { reason: format!("{}, on one side", found.reason), ..found };
    }
    Evidence { needed: false, reason: "0 surfaces that emit on one side".into(), count: 0 }
}

/// Evidence that a shape emits light.
pub fn emissive_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| material_kind_evidence::<Emissive>(scene, "emissive surface"))
}
