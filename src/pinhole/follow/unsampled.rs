//! Materials whose BSDF no stage on offer samples.

use crate::extract::{followed_evidence, shape_entities, shape_name};
use crate::material::{BsdfClass, REGISTERED, material_kind};
use crate::plan::{Census, Stage, TileSystems};
use crate::scene::{SceneError, UsesMaterial};
use bevy_ecs::prelude::*;

/// Checks that where paths are traced, a stage on offer samples the BSDF of every specular or glossy material in the
/// scene: a chapter offers the stages taught so far, and other materials would be black without a warning.
///
/// Errors: the first shape of a material that no stage on offer samples.
pub fn check_materials_are_followed(scene: &Census<'_>, offer: &[Stage]) -> Result<(), SceneError> {
    let shapes = shape_entities(scene);
    for own in REGISTERED.iter().filter(|own| own.class != BsdfClass::Diffuse) {
        let table = (own.table)();
        let scatters = |stage: &Stage| stage.set == TileSystems::SampleBsdfs && stage.tables.contains(&table);
        let goes_on = |stage: &Stage| stage.set == TileSystems::RemainingBounces;
        if offer.iter().any(scatters) && offer.iter().any(goes_on) {
            continue;
        }
        let is_made = |entity: Entity| material_kind(scene, entity) == Some(own.kind);
        let made = |&shape: &Entity| {
            let used = scene.get::<UsesMaterial>(shape).map(|used| used.0);
            is_made(shape) || used.is_some_and(is_made)
        };
        if let Some(first) = shapes.iter().position(made).filter(|_| followed_evidence(scene).needed) {
            let accepted = "no stage on offer samples its BSDF; offer stages::all(), which do";
            return Err(SceneError::new(shape_name(scene, first), own.word, "given", accepted));
        }
    }
    Ok(())
}
