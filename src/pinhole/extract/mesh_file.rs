use super::check::kind_and_name;
use super::image_files::shown_name;
use crate::plan::Census;
use crate::scene::{Mesh, MeshPart, SceneError, UnreadMesh};
use bevy_ecs::prelude::*;
use std::collections::BTreeSet;

/// Checks that the model file of every mesh has been read.
///
/// Errors: why one was not.
pub(super) fn check_mesh_files(scene: &Census<'_>) -> Result<(), SceneError> {
    let parts = scene.entities::<With<MeshPart>>();
    let owners: BTreeSet<Entity> =
        parts.iter().filter_map(|&part| scene.get::<MeshPart>(part)).map(|part| part.0).collect();
    for &entity in scene.entities::<With<Mesh>>().iter() {
        let Some(mesh) = scene.get::<Mesh>(entity) else { continue };
        let refused = |why: String| {
            let who = kind_and_name(scene, "mesh", entity);
            Err(SceneError::new(who, "file", shown_name(&mesh.file), why))
        };
        if let Some(UnreadMesh(why)) = scene.get::<UnreadMesh>(entity) {
            return refused(why.clone());
        }
        if !owners.contains(&entity) {
            return refused("it has not been read: `load_meshes` does that".into());
        }
    }
    Ok(())
}
