use bevy_ecs::prelude::*;
use std::path::{Path, PathBuf};

/// The folder that the files which a scene names are relative to; the current one where a scene has none.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct SceneFolder(pub PathBuf);

impl SceneFolder {
    /// The folder of a scene file.
    pub fn of(scene_file: &Path) -> Self {
        Self(scene_file.parent().map(Path::to_path_buf).unwrap_or_default())
    }

    /// Where a file that the scene names is.
    pub fn path_of(scene: &World, file: &str) -> PathBuf {
        scene.get_resource::<Self>().map_or_else(|| PathBuf::from(file), |folder| folder.0.join(file))
    }
}

/// Files that are compiled into the program, for a scene that names them; no folder is searched for these.
#[derive(Resource, Clone, Copy, Debug, Default)]
pub struct EmbeddedFiles(pub &'static [(&'static str, &'static [u8])]);

impl EmbeddedFiles {
    /// What a file holds that the scene names, if it is one of these.
    pub fn find(scene: &World, file: &str) -> Option<&'static [u8]> {
        let Self(files) = *scene.get_resource::<Self>()?;
        files.iter().find(|(name, _)| *name == file).map(|(_, bytes)| *bytes)
    }
}
