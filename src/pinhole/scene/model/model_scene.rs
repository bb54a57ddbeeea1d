use super::components_of::{spawn_camera, spawn_light};
use super::load::load_meshes;
use super::mesh::{Mesh, ModelNotes};
use super::open_model::open_model;
use crate::scene::{
    Degrees, DirectionalLight, FileProblem, FovAxis, Gradient, Integrator, LookAt, Name, PerspectiveCamera, Resolution,
    Rgb, Sampling, SceneFolder, printable_path,
};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole_models::{Instance, LightKind, Model, ModelLight};
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

/// The endings of the model files that can be read.
const ENDINGS: [&str; 4] = ["gltf", "glb", "obj", "ply"];
/// The field of view of a camera that is fitted to the model.
const FOV: Degrees = Degrees(36.0);

/// The part of the picture's height that a fitted model fills.
const FILLED: f64 = 0.9;

/// Whether a path is that of a model file, by its ending.
pub fn is_model_file(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    ending.is_some_and(|ending| ENDINGS.contains(&ending.as_str()))
}

/// A scene that consists of a model file, and of a camera and lights where the file has none.
#[derive(Clone, Debug)]
pub struct ModelScene {
    /// The file's path as it was given.
    pub path: PathBuf,
    /// What was added and what was left out, one sentence each.
    pub said: Vec<String>,
}

impl ModelScene {
    /// Reads the file.
    ///
    /// Errors: it cannot be read.
    pub fn open(path: &Path) -> Result<Self, FileProblem> {
        if !path.exists() {
            return Err(FileProblem::of(path, "there is no such file"));
        }
        let named = path.to_string_lossy();
        let model = open_model(&World::new(), &named).map_err(|what| {
            // The problem names the path itself.
            let own = format!("{} ", printable_path(path));
            FileProblem::of(path, what.strip_prefix(&own).unwrap_or(&what))
        })?;
        let mut said = Vec::new();
        if model.model.instances.is_empty() {
            return Err(FileProblem::of(path, "it has no triangles, and there is nothing to render"));
        }
        match model.model.cameras.len() {
            0 => said.push("it has no camera: one is fitted to its bounding box".into()),
            1 => {}
            count => said.push(format!("it has {count} cameras: the first is used")),
        }
        if !model.model.lights.is_empty() {
            let factor = exposure(&model.model);
            said.push(format!("its lights are multiplied by {factor:.1e}, to expose what is at its centre"));
        }
        if !has_lights(&model.model) {
            said.push("it has no light: a sky and a sun are added".into());
        }
        Ok(Self { path: path.into(), said })
    }

    /// The scene as a world.
    pub fn world(&self) -> World {
        let mut scene = World::new();
        let named = self.path.to_string_lossy().into_owned();
        let open = open_model(&scene, &named);
        let camera = open.as_ref().ok().and_then(|open| Some(spawn_camera(&mut scene, open.model.cameras.first()?)));
        let camera = camera.unwrap_or_else(|| {
            let looks = open.as_ref().map_or_else(|_| LookAt::default(), |open| fitted(&open.model));
            let fitted = PerspectiveCamera { fov: FOV, axis: FovAxis::Smaller };
            scene.spawn((Name::new("fitted camera"), fitted, looks)).id()
        });
        let sampling = Sampling { samples: 16, ..Sampling::default() };
        let resolution = Resolution { width: 640, height: 360 };
        scene.entity_mut(camera).insert((resolution, sampling, Integrator::PATH));
        if let Ok(open) = &open {
            let exposure = exposure(&open.model);
            for light in &open.model.lights {
                spawn_light(&mut scene, &ModelLight { intensity: light.intensity * exposure, ..light.clone() });
            }
            if !has_lights(&open.model) {
                let sky = Gradient { bottom: Rgb::grey(0.2), top: Rgb::new(0.36, 0.46, 0.64) };
                scene.spawn((Name::new("added sky"), sky));
                let shines = LookAt { eye: DVec3::new(0.6, 1.0, 0.5), target: DVec3::ZERO, ..LookAt::default() };
                let sun = DirectionalLight { irradiance: Rgb::new(1.8, 1.7, 1.5), casts_shadows: true };
                scene.spawn((Name::new("added sun"), sun, shines));
            }
        }
        let name = self.path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        scene.spawn((Mesh { file: named }, Name::new(name)));
        scene.insert_resource(ModelNotes(self.said.clone()));
        load_meshes(&mut scene);
        scene.insert_resource(SceneFolder::default());
        scene
    }
}

fn has_lights(model: &Model) -> bool {
    // Textures of emission are mostly black, and what they light is little.
    let emits = |material: usize| {
        let own = model.materials.get(material);
        own.is_some_and(|own| own.emission != [0.0; 3] && own.emission_texture.is_none())
    };
    !model.lights.is_empty() || model.instances.iter().filter_map(|instance| instance.material).any(emits)
}

/// From the upper right of the front, as near as all vertices are in the picture.
fn fitted(model: &Model) -> LookAt {
    let (low, high) = bounds_of(model);
    let (target, size) = (0.5 * (low + high), (high - low).length().max(f64::MIN_POSITIVE));
    let towards = DVec3::new(0.5, 0.4, 1.0).normalize();
    let right = DVec3::Y.cross(towards).normalize();
    let up = towards.cross(right);
    let tangent = libm::tan(0.5 * FOV.0.to_radians()) * FILLED;
    let away = |at: DVec3| {
        let apart = at - target;
        apart.dot(towards) + apart.dot(right).abs().max(apart.dot(up).abs()) / tangent
    };
    let away = vertices(model).map(away).fold(1e-3 * size, f64::max);
    LookAt { eye: target + towards * away, target, ..LookAt::default() }
}

/// The vertices of all instances in world space, but for those that are not finite.
fn vertices(model: &Model) -> impl Iterator<Item = DVec3> {
    let of = |instance: &Instance| {
        let matrix = instance.world_from_object;
        let positions = model.meshes[instance.mesh].positions.iter();
        positions.map(move |position| matrix.transform_point3(position.map(f64::from).into()))
    };
    model.instances.iter().flat_map(of).filter(|at| at.is_finite())
}

fn bounds_of(model: &Model) -> (DVec3, DVec3) {
    vertices(model).fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)))
}

/// The factor by which the lights of a model are multiplied, for a white surface at the centre of the bounding box to be
/// white in the picture: model files give photometric units, and leave the exposure to the program.
fn exposure(model: &Model) -> f64 {
    let (low, high) = bounds_of(model);
    let centre = 0.5 * (low + high);
    let falling = |light: &ModelLight| {
        let apart = (light.world_from_light.translation - centre).length_squared().max(f64::MIN_POSITIVE);
        let strength = light.intensity * light.colour.into_iter().fold(0.0, f64::max);
        if light.kind == LightKind::Directional { strength } else { strength / apart }
    };
    let irradiance: f64 = model.lights.iter().map(falling).sum();
    let factor = PI / irradiance;
    if factor.is_finite() && factor > 0.0 { factor } else { 1.0 }
}
