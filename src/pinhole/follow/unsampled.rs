//! Materials whose BSDF no stage on offer samples.

use crate::extract::{
    GlassTable, MetalTable, MirrorTable, camera_entity, followed_evidence, integrator_of, shape_entities, shape_name,
};
use crate::plan::{Census, Stage, TableKind, TileSystems};
use crate::scene::{Glass, Metal, Mirror, SceneError, UsesMaterial, called};
use bevy_ecs::prelude::*;

/// Checks that where paths are traced, a stage on offer samples the BSDF of every mirror, glass and metal in the scene:
/// a chapter offers the stages taught so far, and other materials would be black without a warning.
///
/// Errors: the first shape of a material that no stage on offer samples; a sky whose light none finds.
pub fn check_materials_are_followed(scene: &Census<'_>, offer: &[Stage]) -> Result<(), SceneError> {
    check_sky_is_followed(scene, offer)?;
    let shapes = shape_entities(scene);
    let unsampled = |word: &'static str, table: TableKind, is_made: &dyn Fn(EntityRef<'_>) -> bool| {
        let scatters = |stage: &Stage| stage.set == TileSystems::SampleBsdfs && stage.tables.contains(&table);
        let goes_on = |stage: &Stage| stage.set == TileSystems::RemainingBounces;
        if offer.iter().any(scatters) && offer.iter().any(goes_on) {
            return Ok(());
        }
        let made = |&shape: &Entity| {
            let used = scene.get::<UsesMaterial>(shape).and_then(|used| scene.get_entity(used.0).ok());
            is_made(scene.entity(shape)) || used.is_some_and(is_made)
        };
        let Some(first) = shapes.iter().position(made).filter(|_| followed_evidence(scene).needed) else {
            return Ok(());
        };
        let accepted = "no stage on offer samples its BSDF; offer stages::all(), which do";
        Err(SceneError::new(shape_name(scene, first), word, "given", accepted))
    };
    unsampled("mirror", TableKind::of::<MirrorTable>(), &|entity| entity.contains::<Mirror>())?;
    unsampled("glass", TableKind::of::<GlassTable>(), &|entity| entity.contains::<Glass>())?;
    unsampled("metal", TableKind::of::<MetalTable>(), &|entity| entity.contains::<Metal>())
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
