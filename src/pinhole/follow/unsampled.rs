//! Materials whose BSDF no stage on offer samples, and light that no stage on offer adds.

use super::distance_stage;
use super::emission::mis_emission_evidence;
use crate::extract::{camera_entity, emissive_evidence, followed_evidence, integrator_of, shape_entities, shape_name};
use crate::material::{BsdfClass, material_kind, media_entities, registered_materials};
use crate::plan::{Census, Stage, TileSystems};
use crate::scene::{SceneError, UsesMaterial, called};
use crate::shade::emissive_stage;
use bevy_ecs::prelude::*;

/// Checks that where paths are traced, a stage on offer samples the BSDF of every specular or glossy material in the
/// scene: a chapter offers the stages taught so far, and other materials would be black without a warning.
///
/// Errors: the first shape of a material that no stage on offer samples; a sky whose light none finds, or emission that
/// none adds.
pub fn check_materials_are_followed(scene: &Census<'_>, offer: &[Stage]) -> Result<(), SceneError> {
    check_sky_is_followed(scene, offer)?;
    check_media_are_followed(scene, offer)?;
    check_emission_is_added(scene, offer)?;
    let shapes = shape_entities(scene);
    for own in registered_materials(scene).filter(|own| own.class != BsdfClass::Diffuse) {
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

/// Checks that a stage on offer attenuates light in the media of a scene.
fn check_media_are_followed(scene: &Census<'_>, offer: &[Stage]) -> Result<(), SceneError> {
    let media = media_entities(scene);
    let Some(&first) = media.first().filter(|_| !offer.contains(&distance_stage())) else { return Ok(()) };
    let accepted = "no stage on offer follows light through it; offer stages::all(), which do";
    Err(SceneError::new(called(scene, first), "medium", "given", accepted))
}

/// Checks that paths which hit an emissive surface find its light, where nothing else finds it.
fn check_emission_is_added(scene: &Census<'_>, offer: &[Stage]) -> Result<(), SceneError> {
    let found = emissive_evidence(scene);
    let adds = emissive_stage();
    let is_sampled = mis_emission_evidence(scene).needed;
    if !(found.needed && followed_evidence(scene).needed) || is_sampled || offer.contains(&adds) {
        return Ok(());
    }
    let value = integrator_of(scene).integrator.in_words();
    let accepted = format!(
        "\"{}\" is not on offer, so that paths find no light by hitting it ({}): offer stages::all(), which adds it",
        adds.name, found.reason
    );
    let camera = camera_entity(scene)?;
    Err(SceneError::new(format!("camera {}", called(scene, camera)), "integrator", value, accepted))
}

/// Checks that a sky which lights the scene is found by paths, where no integrator is named.
fn check_sky_is_followed(scene: &Census<'_>, offer: &[Stage]) -> Result<(), SceneError> {
    let chosen = integrator_of(scene);
    let goes_on = offer.iter().any(|stage| stage.set == TileSystems::RemainingBounces);
    let Some(camera) = camera_entity(scene).ok().filter(|_| chosen.without_sky.is_some() && !goes_on) else {
        return Ok(());
    };
    let value = format!("path tracing ({})", chosen.reason);
    let accepted = "no stage on offer continues paths: name RayCasting on the camera, or offer stages::all()";
    Err(SceneError::new(format!("camera {}", called(scene, camera)), "integrator", value, accepted))
}
