//! The meshes of an exported scene: those that a program made are written beside the file, and the model files of the
//! others stay where they are, since they may name files of their own.

use super::error::{Error, Result};
use super::export_images::{OTHERS, name_below, place_beside};
use bevy_ecs::prelude::World;
use pinhole::film::{Replaces, write_whole};
use pinhole::models::glb_of;
use pinhole::scene::{MODEL_FILE, Mesh, SceneFolder, meshes_in_memory, printable_path};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Writes every mesh in memory as a .glb file beside the scene file, and names it in the scene.
///
/// Returns the files that were written; one that holds these very bytes is used as it is.
/// Errors: a mesh of more than 4 GiB, or a file that cannot be written.
pub fn write_meshes(world: &mut World, file: &Path) -> Result<Vec<PathBuf>> {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    name_models(world, Some(folder));
    let mut made = Vec::new();
    for mesh in meshes_in_memory(world) {
        let own = Path::new(&mesh.file);
        let refused = |why: &str| Error::usage(format!("cannot write {}: {}: {why}", printable_path(file), mesh.file));
        let bytes = glb_of(&mesh.geometry).ok_or_else(|| refused("a .glb file has at most 4 GiB"))?;
        let (free, is_new) = place_beside(folder, own, &bytes, MODEL_FILE).ok_or_else(|| refused(OTHERS))?;
        if is_new {
            write_whole(Replaces::Nothing.at(&folder.join(&free)), |file| file.write_all(&bytes))?;
            made.push(folder.join(&free));
        }
        for instance in mesh.instances {
            world.entity_mut(instance).insert(Mesh { file: free.clone(), ..Mesh::default() });
        }
    }
    Ok(made)
}

/// Names every model file by its path from this folder if it lies there or below, and otherwise by its whole path.
pub fn name_models(world: &mut World, folder: Option<&Path>) {
    let mut renamed = BTreeMap::new();
    for Mesh { file, .. } in world.query::<&Mesh>().iter(world) {
        let path = SceneFolder::path_of(world, file);
        let whole = || std::path::absolute(&path).unwrap_or(path.clone()).to_string_lossy().into_owned();
        let name = folder.and_then(|folder| name_below(folder, &path)).unwrap_or_else(whole);
        renamed.insert(file.clone(), name);
    }
    world.query::<&mut Mesh>().iter_mut(world).for_each(|mut mesh| mesh.file = renamed[&mesh.file].clone());
}
