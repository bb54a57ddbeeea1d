use super::closed::is_closed;
use super::image_found::{check_bytes, check_file, ending_of, found_beside};
use super::mesh::Mesh;
use crate::{
    EmbeddedFiles, FileKind, FileStore, MeshGeometry, SceneFolder, Undecoded, check_memory, printable, printable_path,
    read_file,
};
use bevy_ecs::prelude::*;
use pinhole_models::{ImageSource, Model, ModelError, Moment, read_model_at};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// The kind of file that a mesh names.
pub const MODEL_FILE: FileKind = FileKind { name: "a model", max: 4 << 30 };

/// What an instance of a mesh takes in a scene with all that is made of it, in bytes.
const BYTES_A_PART: u64 = 4096;

/// Models that have been read.
static MODELS: FileStore<OpenModel> = FileStore::new();

/// The time at which the animations of model files are shown, of which all meshes that are loaded later take account;
/// without it they are shown at rest.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq)]
pub struct SceneTime {
    /// In seconds, from the beginning of every animation.
    pub seconds: f64,
}

/// The animated models of a scene at its time, by their paths and animations: they last as long as the scene, for the
/// next picture of a film needs others.
#[derive(Resource, Debug, Default)]
struct AnimatedModels(BTreeMap<(PathBuf, String), Arc<OpenModel>>);

/// Whether an animated model of a scene may still change after a time, in seconds.
pub fn animates_after(scene: &World, seconds: f64) -> bool {
    let Some(AnimatedModels(models)) = scene.get_resource() else { return false };
    // A file that does not say how long an animation is says 0.
    let lasts = |length: f64| length == 0.0 || length > seconds;
    models.values().flat_map(|own| &own.model.animations).any(|animation| lasts(animation.seconds))
}

/// A model with its meshes as all of their instances share them.
#[derive(Debug)]
pub struct OpenModel {
    /// What the file holds.
    pub model: Model,
    /// Its meshes.
    pub geometry: Vec<MeshGeometry>,
    /// Whether each mesh encloses an interior; asked only where it matters.
    closed: Vec<OnceLock<bool>>,
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

    /// Keeps an image under the first name that no other image has: two models may have one name.
    fn keep(&mut self, bytes: &Arc<[u8]>, name: impl Fn(usize) -> String) -> String {
        let mut numbered = (1..).map(name);
        let is_free = |name: &String| self.0.get(name).is_none_or(|other| other == bytes);
        let name = numbered.find(is_free).unwrap_or_default();
        self.0.insert(name.clone(), Arc::clone(bytes));
        name
    }
}

/// Reads the model that a scene names at rest, if that has not been done.
///
/// Errors: why it was not read, as a clause.
pub fn open_model(scene: &World, file: &str) -> Result<Arc<OpenModel>, String> {
    let path = SceneFolder::path_of(scene, file);
    if let Some(bytes) = EmbeddedFiles::find(scene, file) {
        return read(&path, bytes, None).map(|(model, _)| Arc::new(model));
    }
    MODELS.get(&path, MODEL_FILE, |bytes| read(&path, bytes, None)).map_err(|why| match why {
        Undecoded::File(error) => error.to_string(),
        Undecoded::Content(problem) => problem,
    })
}

/// Reads the model that a mesh names at the scene's time, if it has one and the model has animations.
///
/// Errors: why it was not read, as a clause.
pub fn open_model_now(scene: &mut World, Mesh { file, animation, .. }: &Mesh) -> Result<Arc<OpenModel>, String> {
    let at_rest = open_model(scene, file)?;
    let Some(SceneTime { seconds }) = scene.get_resource().copied() else { return Ok(at_rest) };
    let path = SceneFolder::path_of(scene, file);
    if at_rest.model.animations.is_empty() {
        let shown = printable_path(&path);
        return if animation.is_empty() { Ok(at_rest) } else { Err(format!("{shown} has no animations")) };
    }
    let key = (path, animation.clone());
    if let Some(known) = scene.get_resource::<AnimatedModels>().and_then(|known| known.0.get(&key)) {
        return Ok(Arc::clone(known));
    }
    let moment = Moment { seconds, animation: (!animation.is_empty()).then_some(animation) };
    let (model, _) = match EmbeddedFiles::find(scene, file) {
        Some(bytes) => read(&key.0, bytes, Some(moment))?,
        None => {
            let bytes = read_file(&key.0, MODEL_FILE).map_err(|error| error.to_string())?;
            read(&key.0, &bytes, Some(moment))?
        }
    };
    let model = Arc::new(model);
    scene.get_resource_or_init::<AnimatedModels>().0.insert(key, Arc::clone(&model));
    Ok(model)
}

fn read(path: &Path, bytes: &[u8], moment: Option<Moment<'_>>) -> Result<(OpenModel, usize), String> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let beside = |name: &str| read_file(&found_beside(folder, name), MODEL_FILE).map_err(|error| error.to_string());
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let model = read_model_at(&name, bytes, moment, &beside)
        .map_err(|problem| format!("{} cannot be read: {}", printable_path(path), without_file(&name, &problem)))?;
    let parts = model.instances.len() as u64;
    check_memory(parts * BYTES_A_PART)
        .map_err(|too_little| format!("{} has {parts} parts, which {too_little}", printable_path(path)))?;
    let geometry: Vec<MeshGeometry> = model.meshes.iter().map(|mesh| MeshGeometry::new(Arc::clone(mesh))).collect();
    let images = model.images.iter().map(|image| match &image.source {
        ImageSource::Bytes(bytes) => bytes.len(),
        ImageSource::File(_) => 0,
    });
    let size = model.meshes.iter().map(|mesh| mesh.bytes()).sum::<usize>() + images.sum::<usize>();
    let closed = geometry.iter().map(|_| OnceLock::new()).collect();
    Ok((OpenModel { model, geometry, closed, path: path.into() }, size))
}

/// What is wrong with a model, without the name of the file where that is the model itself, which has been named.
fn without_file(name: &str, problem: &ModelError) -> String {
    let said = problem.to_string();
    let own = format!("{}: ", printable(name, 200));
    said.strip_prefix(&own).map_or_else(|| said.clone(), str::to_owned)
}

/// Meshes of more triangles than this are not asked whether they are closed where only a remark depends on it.
const MANY: usize = 200_000;

impl OpenModel {
    /// The meshes of a material.
    fn meshes_of(&self, material: usize) -> impl Iterator<Item = usize> {
        let own = self.model.instances.iter().filter(move |instance| instance.material == Some(material));
        own.map(|instance| instance.mesh)
    }

    fn is_closed_mesh(&self, mesh: usize) -> bool {
        *self.closed[mesh].get_or_init(|| is_closed(&self.model.meshes[mesh]))
    }

    /// Why there is nothing of it to see, as a clause: what it has in place of triangles.
    pub fn nothing(&self) -> String {
        let there = self.model.remarks.sentences();
        if there.is_empty() {
            return "it has no triangles".into();
        }
        let there: Vec<&str> = there.iter().map(|sentence| sentence.trim_end_matches('.')).collect();
        format!("it has no triangles that could be drawn: {}", there.join("; "))
    }

    /// Whether every mesh of a material encloses an interior.
    pub fn is_closed(&self, material: usize) -> bool {
        self.meshes_of(material).all(|mesh| self.is_closed_mesh(mesh))
    }

    /// Whether some mesh of a material can be seen from behind.
    pub fn is_open_somewhere(&self, material: usize) -> bool {
        let is_large = |mesh: usize| self.model.meshes[mesh].triangles.len() > MANY;
        self.meshes_of(material).any(|mesh| is_large(mesh) || !self.is_closed_mesh(mesh))
    }

    /// The name by which a texture can name one of the model's images, which the scene then knows.
    ///
    /// Errors: why it cannot be read, with its name.
    pub fn name_of_image(&self, scene: &mut World, image: usize) -> Result<String, String> {
        let Some(own) = self.model.images.get(image) else { return Err("it is not in the model".into()) };
        match &own.source {
            ImageSource::File(name) => {
                let path = found_beside(self.path.parent().unwrap_or(Path::new("")), name);
                // Texture files are named relative to the scene's folder, and an absolute path stays as it is.
                let path = std::path::absolute(&path).unwrap_or(path);
                check_file(&path).map_err(|why| {
                    let shown = printable_path(&path);
                    if why.contains(&shown) { why } else { format!("{shown}: {why}") }
                })?;
                Ok(path.to_string_lossy().into_owned())
            }
            ImageSource::Bytes(bytes) => {
                let model = self.path.file_name().map(|name| name.to_string_lossy()).unwrap_or_default();
                let name = format!("{}, image {image}", self.path.to_string_lossy());
                check_bytes(&name, bytes).map_err(|why| format!("{}, image {image}: {why}", printable(&model, 80)))?;
                let ending = ending_of(bytes);
                Ok(scene.get_resource_or_init::<ModelFiles>().keep(bytes, |number| match number {
                    1 => format!("{model}, image {image}.{ending}"),
                    _ => format!("{model} ({number}), image {image}.{ending}"),
                }))
            }
        }
    }
}
