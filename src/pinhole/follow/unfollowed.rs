//! Matter that no stage on offer sends light on from.

use crate::extract::{GlassTable, MetalTable, MirrorTable, ShapeTable, followed_evidence, shape_entities};
use crate::plan::{Stage, Table, TableKind, TileSystems};
use crate::scene::{Glass, Metal, Mirror, SceneError, UsesMaterial};
use bevy_ecs::prelude::*;

/// Checks that where light is followed, stages on offer do so at every mirror, glass and metal of the scene: a chapter
/// offers the stages taught so far, and such matter would be black in its picture without a word.
///
/// Errors: the first shape of such matter that no stage on offer sends light on from.
pub fn check_materials_are_followed(scene: &World, offer: &[Stage]) -> Result<(), SceneError> {
    let shapes = shape_entities(scene);
    let unmet = |word: &'static str, table: TableKind, is_made: &dyn Fn(EntityRef<'_>) -> bool| {
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
        let name = ShapeTable::extract(scene)?.name.get(first).cloned().unwrap_or_default();
        let accepted = "no stage on offer sends light on from it; offer stages::all(), which do";
        Err(SceneError::new(name, word, "given", accepted))
    };
    unmet("mirror", TableKind::of::<MirrorTable>(), &|entity| entity.contains::<Mirror>())?;
    unmet("glass", TableKind::of::<GlassTable>(), &|entity| entity.contains::<Glass>())?;
    unmet("metal", TableKind::of::<MetalTable>(), &|entity| entity.contains::<Metal>())
}
