//! The text of a chapter's scene, whose values can be set.

use super::error::{Error, Result};
use super::export_images::{held_image, name_images_whole, place_beside};
use super::export_meshes::name_models;
use super::subject::own_view;
use bevy_ecs::prelude::*;
use pinhole::extract::{camera_entity, integrator_of};
use pinhole::models::glb_of;
use pinhole::plan::Census;
use pinhole::scene::{
    EmbeddedFiles, MODEL_FILE, Mesh, MeshInMemory, MeshInstance, ModelFiles, SceneError, SceneFile, UnreadMesh,
    meshes_in_memory, scene_text,
};
use pinhole::{Chapter, Overrides};
use std::path::Path;
use std::sync::Arc;

/// What the text of a scene names and only the program holds.
#[derive(Clone, Default)]
pub struct Held {
    /// Meshes, each with the name that the text has for it.
    pub meshes: Vec<MeshInMemory>,
    /// Images with their names.
    pub files: Vec<(String, Arc<[u8]>)>,
    embedded: Option<EmbeddedFiles>,
    of_models: Option<ModelFiles>,
}

/// The text of a scene, and what it names that no file holds.
pub fn text_of(mut world: World) -> (std::result::Result<String, SceneError>, Held) {
    name_models(&mut world, None);
    let meshes = meshes_in_memory(&world);
    text_with(world, meshes)
}

/// The same for a text beside which the meshes are to be written, under names that begin with a stem and are those of no
/// other files.
pub fn text_beside(mut world: World, folder: &Path, stem: &str) -> (std::result::Result<String, SceneError>, Held) {
    name_models(&mut world, None);
    let mut meshes = meshes_in_memory(&world);
    for mesh in &mut meshes {
        let name = format!("{stem}-{}", mesh.file);
        let free = glb_of(&mesh.geometry)
            .and_then(|bytes| place_beside(folder, Path::new(&name), &bytes, MODEL_FILE))
            .map_or(name, |(free, _)| free);
        for &instance in &mesh.instances {
            world.entity_mut(instance).insert(Mesh { file: free.clone(), ..Mesh::default() });
        }
        mesh.file = free;
    }
    text_with(world, meshes)
}

fn text_with(mut world: World, meshes: Vec<MeshInMemory>) -> (std::result::Result<String, SceneError>, Held) {
    let only_here = name_images_whole(&mut world);
    let embedded = world.get_resource::<EmbeddedFiles>().copied();
    let of_models = world.get_resource::<ModelFiles>().cloned();
    let bytes_of = |name: String| Some((name.clone(), held_image(&world, &name)?));
    let files = only_here.into_iter().filter_map(bytes_of).collect();
    (scene_text(&world), Held { meshes, files, embedded, of_models })
}

impl Held {
    /// Gives the scene of an edited text what only the program holds.
    pub fn fill_in(&self, world: &mut World) {
        if let Some(embedded) = self.embedded {
            world.insert_resource(embedded);
        }
        if let Some(of_models) = &self.of_models {
            world.insert_resource(of_models.clone());
        }
        let unread: Vec<(Entity, String)> = world
            .query_filtered::<(Entity, &Mesh), With<UnreadMesh>>()
            .iter(world)
            .map(|(entity, mesh)| (entity, mesh.file.clone()))
            .collect();
        for (entity, file) in unread {
            if let Some(mesh) = self.meshes.iter().find(|mesh| mesh.file == file) {
                let mut entity = world.entity_mut(entity);
                entity.remove::<(Mesh, UnreadMesh)>();
                entity.insert(MeshInstance { geometry: mesh.geometry.clone() });
            }
        }
    }
}

/// A chapter with the text of its scene.
pub struct ChapterText {
    chapter: Chapter,
    file: SceneFile,
    held: Arc<Held>,
}

impl ChapterText {
    /// Writes the scene of a chapter as text.
    ///
    /// Errors: something in it has no word in scene files.
    pub fn of(chapter: &Chapter) -> Result<Self> {
        let mut chapter = chapter.clone();
        let mut world = chapter.world(&Overrides::default());
        // A column that the text names is the scene's own from now on, and can be set as well.
        if own_view(&mut world).is_none() {
            chapter.view = None;
        }
        let (text, held) = text_of(world);
        // No such folder is there, so that no file is taken for a mesh that the program holds.
        let file = SceneFile::parse(&Path::new(chapter.name).join("scene.ron"), text?)?;
        Ok(Self { chapter, file, held: Arc::new(held) })
    }

    /// The chapter with other values in its scene.
    ///
    /// Errors: one sentence about the first setting that cannot be followed.
    pub fn set(&self, settings: &[impl AsRef<str>]) -> Result<Chapter> {
        let Some((first, more)) = settings.split_first() else { return Ok(self.chapter.clone()) };
        let mut file = self.file.set(first.as_ref()).map_err(Error::usage)?;
        for setting in more {
            file = file.set(setting.as_ref()).map_err(Error::usage)?;
        }
        Ok(self.with(file))
    }

    /// The scene as a file.
    pub fn file(&self) -> &SceneFile {
        &self.file
    }

    /// The chapter with another text of its scene.
    pub fn with(&self, file: SceneFile) -> Chapter {
        let held = Arc::clone(&self.held);
        self.chapter.clone().with_scene(move |world| {
            *world = file.world();
            held.fill_in(world);
        })
    }

    /// The text of a value, or that of its default.
    ///
    /// Errors: one sentence that says what there is instead.
    pub fn value(&self, path: &str) -> Result<String> {
        // Where the camera names no integrator, the scene decides which one it is.
        let chosen = |_| {
            let mut world = self.chapter.world(&Overrides::default());
            let integrator = integrator_of(&Census::of(&world)).integrator;
            let camera = camera_entity(&world)?;
            world.entity_mut(camera).insert(integrator);
            let file = SceneFile::parse(&self.file.path, text_of(world).0?)?;
            file.value(path).map_err(Error::usage)
        };
        self.file.value(path).or_else(chosen)
    }
}
