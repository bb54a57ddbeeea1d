use crate::scene::{
    EmbeddedFiles, FileKind, FileStore, MeshGeometry, SceneFolder, Undecoded, printable_path, read_file,
};
use bevy_ecs::prelude::*;
use pinhole_models::{ImageSource, Model, read_model};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The kind of file that a mesh names.
pub const MODEL_FILE: FileKind = FileKind { name: "a model", most: 4 << 30 };

/// Models that have been read.
static MODELS: FileStore<OpenModel> = FileStore::new();

/// A model with its meshes as all of their instances share them.
#[derive(Debug)]
pub struct OpenModel {
    /// What the file holds.
    pub model: Model,
    /// Its meshes.
    pub geometry: Vec<MeshGeometry>,
    /// The path that it was read from.
    path: PathBuf,
}

/// Images that model files hold, by the names that textures give them.
#[derive(Resource, Clone, Debug, Default)]
pub struct ModelFiles(BTreeMap<String, Arc<[u8]>>);

impl ModelFiles {
    /// The bytes of an image that a model file holds.
    pub fn find(scene: &World, file: &str) -> Option<Arc<[u8]>> {
        scene.get_resource::<Self>()?.0.get(file).cloned()
    }
}

/// Reads the model that a scene names, if that has not been done.
///
/// Errors: why it was not read, as a clause.
pub fn open_model(scene: &World, file: &str) -> Result<Arc<OpenModel>, String> {
    let path = SceneFolder::path_of(scene, file);
    if let Some(bytes) = EmbeddedFiles::find(scene, file) {
        return read(&path, bytes).map(|(model, _)| Arc::new(model));
    }
    MODELS.get(&path, MODEL_FILE, |bytes| read(&path, bytes)).map_err(|why| match why {
        Undecoded::File(error) => error.to_string(),
        Undecoded::Content(problem) => problem,
    })
}

fn read(path: &Path, bytes: &[u8]) -> Result<(OpenModel, usize), String> {
    let beside = |name: &str| {
        let path = path.parent().map_or_else(|| PathBuf::from(name), |folder| folder.join(name));
        read_file(&path, MODEL_FILE).map_err(|error| error.to_string())
    };
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let model = read_model(&name, bytes, &beside)
        .map_err(|problem| format!("{} cannot be read: {problem}", printable_path(path)))?;
    let geometry = model.meshes.iter().map(|mesh| MeshGeometry::new(Arc::clone(mesh))).collect();
    let size = model.meshes.iter().map(|mesh| mesh.bytes()).sum();
    Ok((OpenModel { model, geometry, path: path.into() }, size))
}

impl OpenModel {
    /// The name by which a texture can name one of the model's images, which the scene then knows.
    pub fn name_of_image(&self, scene: &mut World, image: usize) -> Option<String> {
        let image = self.model.images.get(image).map(|own| (image, &own.source));
        match image? {
            (_, ImageSource::File(name)) => {
                let path = self.path.parent().map_or_else(|| PathBuf::from(&**name), |folder| folder.join(&**name));
                // Texture files are named relative to the scene's folder, and an absolute path stays as it is.
                let absolute = std::path::absolute(&path).ok()?;
                Some(absolute.to_string_lossy().into_owned())
            }
            (number, ImageSource::Bytes(bytes)) => {
                let ending = if bytes.starts_with(&[0xff, 0xd8]) { "jpg" } else { "png" };
                let model = self.path.file_name().map(|name| name.to_string_lossy()).unwrap_or_default();
                let name = format!("{model}, image {number}.{ending}");
                scene.get_resource_or_init::<ModelFiles>().0.insert(name.clone(), Arc::clone(bytes));
                Some(name)
            }
        }
    }
}
