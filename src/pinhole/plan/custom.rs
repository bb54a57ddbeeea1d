use super::{Census, Stage, Table, TableKind};
use crate::scene::{SceneError, called};
use bevy_ecs::prelude::*;
use std::any::TypeId;
use std::sync::Arc;

/// The kinds of one family that a program adds to those of the library, by their types: they stand in the scene that may
/// have them.
#[derive(Resource)]
struct Custom<K: Send + Sync + 'static>(Vec<(TypeId, K)>);

/// What is added to a scene, of all families.
#[derive(Resource, Default)]
struct AllCustom(Vec<Added>);

/// What is known of everything that a program adds.
#[derive(Clone, Copy)]
pub(crate) struct Added {
    /// Its table, which its stages read.
    pub table: TableKind,
    /// Its component in messages.
    pub word: &'static str,
    /// The entities that have the component.
    pub entities: fn(&Census<'_>) -> Arc<[Entity]>,
    /// The function that makes its stages.
    pub stages: &'static str,
}

/// Adds the kind that a type is to a scene, once.
pub(crate) fn add_kind<T: 'static, K: Send + Sync + 'static>(scene: &mut World, kind: K, added: Added) {
    let mut kinds = scene.get_resource_or_insert_with(|| Custom(Vec::new()));
    if !kinds.0.iter().any(|(of, _)| *of == TypeId::of::<T>()) {
        kinds.0.push((TypeId::of::<T>(), kind));
        scene.get_resource_or_init::<AllCustom>().0.push(added);
    }
}

/// The kinds of the library, and then those that a scene adds.
pub(crate) fn with_added<'s, K: Send + Sync + 'static>(
    listed: &'s [K],
    scene: &'s World,
) -> impl Iterator<Item = &'s K> + Clone {
    let added = scene.get_resource::<Custom<K>>().map_or(&[][..], |added| &added.0);
    listed.iter().chain(added.iter().map(|(_, kind)| kind))
}

/// Checks that the stages of everything that a program adds are on offer where a scene has it.
///
/// Errors: what no stage on offer knows of.
pub(crate) fn check_added(scene: &Census<'_>, offer: &[Stage]) -> Result<(), SceneError> {
    let is_offered = |table: &TableKind| offer.iter().any(|stage| stage.tables.contains(table));
    for added in all_of(scene).iter().filter(|added| !is_offered(&added.table)) {
        if let Some(&first) = (added.entities)(scene).first() {
            let who = format!("{} {}", added.word, called(scene, first));
            let accepted = format!("no stage on offer knows of it; offer those of extend::{}", added.stages);
            return Err(SceneError::new(who, "stages", "missing", accepted));
        }
    }
    Ok(())
}

/// Checks that a scene says that it may have what is in a table, where that is not the library's.
///
/// Errors: that it does not.
pub(crate) fn check_is_added<T: Table>(scene: &Census<'_>, word: &str, by: &str) -> Result<(), SceneError> {
    if all_of(scene).iter().any(|added| added.table.is::<T>()) {
        return Ok(());
    }
    Err(SceneError::new(word, "kind", "unknown", format!("the scene must say that it may have one, by extend::{by}")))
}

fn all_of(scene: &World) -> &[Added] {
    scene.get_resource::<AllCustom>().map_or(&[], |added| &added.0)
}
