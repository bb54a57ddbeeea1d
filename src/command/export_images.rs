//! The images and density grids of a scene that is exported: carried along beside the file, or named by their whole paths.

use super::error::{Error, Result};
use bevy_ecs::prelude::*;
use pinhole::film::{Replaces, write_whole};
use pinhole::scene::{
    EmbeddedFiles, FileKind, MeshPart, ModelFiles, SceneFolder, for_each_file_name, named_files, printable_path,
    read_file,
};
use std::collections::BTreeMap;
use std::fmt::Display;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Puts a copy of every image beside the file that will name it, unless it lies there or below already.
///
/// Returns the copies that were made. A file of the same name that holds something else stays, and the copy gets a number.
/// Errors: an image cannot be read, or its copy cannot be written.
pub fn carry_images(world: &mut World, file: &Path) -> Result<Vec<PathBuf>> {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let (mut made, mut new_names) = (Vec::new(), BTreeMap::new());
    for (name, kind) in named_by_text(world) {
        let path = SceneFolder::path_of(world, &name);
        let embedded = held_image(world, &name);
        let kept = if embedded.is_none() { name_below(folder, &path) } else { None };
        let new_name = match kept {
            Some(kept) => kept,
            None => {
                let bytes = embedded.map_or_else(|| read_file(&path, kind), |bytes| Ok(bytes.to_vec()));
                let bytes = bytes.map_err(|why| refused(file, &name, &why))?;
                let (free, is_new) =
                    place_beside(folder, &path, &bytes, kind).ok_or_else(|| refused(file, &name, &OTHERS))?;
                if is_new {
                    write_whole(Replaces::Nothing.at(&folder.join(&free)), |file| file.write_all(&bytes))?;
                    made.push(folder.join(&free));
                }
                free
            }
        };
        new_names.insert(name, new_name);
    }
    rename(world, &new_names);
    Ok(made)
}

/// Names every image by its whole path, for a scene that is printed may be saved anywhere.
///
/// Returns the images that have none, for they are in the program only.
pub fn name_images_whole(world: &mut World) -> Vec<String> {
    let (mut without, mut new_names) = (Vec::new(), BTreeMap::new());
    for name in named_by_text(world).into_keys() {
        let path = SceneFolder::path_of(world, &name);
        let is_compiled_in = EmbeddedFiles::find(world, &name).is_some() && !path.is_file();
        if is_compiled_in || ModelFiles::find(world, &name).is_some() {
            without.push(name);
        } else {
            let whole = std::path::absolute(&path).unwrap_or(path);
            new_names.insert(name, whole.to_string_lossy().into_owned());
        }
    }
    rename(world, &new_names);
    without
}

/// The bytes of an image that is compiled in, or lies within a model file.
pub fn held_image(world: &World, name: &str) -> Option<Arc<[u8]>> {
    ModelFiles::find(world, name).or_else(|| EmbeddedFiles::find(world, name).map(Arc::from))
}

/// The images and density grids that the text of a scene names: not those of materials that stay in a model file.
fn named_by_text(world: &mut World) -> BTreeMap<String, FileKind> {
    let mut names = BTreeMap::new();
    for entity in world.query::<EntityRef<'_>>().iter(world) {
        if entity.get::<MeshPart>().is_some_and(|part| part.0 != entity.id()) {
            continue;
        }
        names.extend(named_files(entity));
    }
    names
}

/// All at once, for one image's new name may be another's old one.
fn rename(world: &mut World, new_names: &BTreeMap<String, String>) {
    let renamed = |file: &mut String| new_names.get(file).into_iter().for_each(|new| file.clone_from(new));
    for_each_file_name(world, renamed);
}

/// Why none is free.
pub const OTHERS: &str = "its folder already holds many other files of this name";

/// What a file in this folder or below it is called from there.
pub fn name_below(folder: &Path, path: &Path) -> Option<String> {
    let (folder, path) = (folder.canonicalize().ok()?, path.canonicalize().ok()?);
    path.strip_prefix(folder).ok()?.to_str().map(String::from)
}

/// The first name in the folder that is free or belongs to a file with these very bytes, and whether it is free.
pub fn place_beside(folder: &Path, path: &Path, bytes: &[u8], kind: FileKind) -> Option<(String, bool)> {
    let text = |part: Option<&std::ffi::OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    let (stem, ending) = (text(path.file_stem()), text(path.extension()));
    for number in 1..1000 {
        let name = if number == 1 { format!("{stem}.{ending}") } else { format!("{stem}-{number}.{ending}") };
        let place = folder.join(&name);
        // What cannot be examined is there.
        if place.symlink_metadata().is_err_and(|why| why.kind() == io::ErrorKind::NotFound) {
            return Some((name, true));
        }
        if read_file(&place, kind).is_ok_and(|there| there == bytes) {
            return Some((name, false));
        }
    }
    None
}

fn refused(file: &Path, name: &str, why: &dyn Display) -> Error {
    Error::usage(format!("cannot write {}: the image {name:?} cannot be copied beside it: {why}", printable_path(file)))
}
