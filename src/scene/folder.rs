use bevy_ecs::prelude::*;
use std::path::{Path, PathBuf};

/// The folder to which a scene's file names are relative; without this resource, the current folder.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct SceneFolder(pub PathBuf);

impl SceneFolder {
    /// The folder of a scene file.
    pub fn of(scene_file: &Path) -> Self {
        Self(scene_file.parent().map(Path::to_path_buf).unwrap_or_default())
    }

    /// The path of a file that the scene names.
    pub fn path_of(scene: &World, file: &str) -> PathBuf {
        scene.get_resource::<Self>().map_or_else(|| PathBuf::from(file), |folder| folder.0.join(file))
    }
}

/// Files compiled into the program, by name; a scene that names one of them reads no folder for it.
#[derive(Resource, Clone, Copy, Debug, Default)]
pub struct EmbeddedFiles(pub &'static [(&'static str, &'static [u8])]);

impl EmbeddedFiles {
    /// The contents of a file that the scene names, if it is compiled in.
    pub fn find(scene: &World, file: &str) -> Option<&'static [u8]> {
        let Self(files) = *scene.get_resource::<Self>()?;
        files.iter().find(|(name, _)| *name == file).map(|(_, bytes)| *bytes)
    }
}
