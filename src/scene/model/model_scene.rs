use super::components_of::{spawn_camera, spawn_light};
use super::lighting::{LitBy, bounds_of, exposure, lit_by, vertices};
use super::load::load_meshes;
use super::mesh::{Mesh, ModelNotes};
use super::open_model::{SceneTime, open_model, open_model_now};
use crate::{
    Degrees, DirectionalLight, Exposure, FileProblem, FovAxis, Gradient, Integrator, LookAt, Name, PerspectiveCamera,
    Resolution, Rgb, Sampling, SceneFolder, Shutter, printable_path,
};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole_models::{Model, ModelAnimation, Projection};
use std::path::{Path, PathBuf};

/// The endings of the model files that can be read.
const ENDINGS: [&str; 4] = ["gltf", "glb", "obj", "ply"];
/// The field of view of a camera that is fitted to the model.
const FOV: Degrees = Degrees(36.0);

/// The part of the picture's height that a fitted model fills.
const FILLED: f64 = 0.9;

/// What is said of the exposure.
const EXPOSED: &str = "its camera is given";
/// The greatest aspect ratio that a picture takes from a camera.
const MAX_OBLONG: f64 = 20.0;

/// Whether a path is that of a model file, by its ending.
pub fn is_model_file(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    ending.is_some_and(|ending| ENDINGS.contains(&ending.as_str()))
}

/// A factor of light in stops, as many as an exposure may have.
fn stops_of(factor: f64) -> f64 {
    libm::log2(factor).clamp(-128.0, 128.0)
}

/// A scene that consists of a model file, and of a camera and lights where the file has none.
#[derive(Clone, Debug)]
pub struct ModelScene {
    /// The file's path as it was given.
    pub path: PathBuf,
    /// What was added and what was left out, one sentence each.
    pub said: Vec<String>,
    /// The factor of the picture's light; the lights themselves are as the file says.
    pub exposure: f64,
    /// Whether materials that the file calls single-sided are not there from behind.
    pub single_sided: bool,
    /// The animation that a film shows, as [`Mesh`] has it.
    pub animation: String,
    /// The animations of the file.
    pub animations: Vec<ModelAnimation>,
    /// The time of the animation that is shown, in seconds; none at rest.
    pub seconds: Option<f64>,
    /// For how long the shutter is open from that time on, in seconds.
    pub shutter: f64,
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
            return Err(FileProblem::of(path, format!("{}, and there is nothing to render", model.nothing())));
        }
        match model.model.cameras.len() {
            0 => said.push("it has no camera: one is fitted to its bounding box".into()),
            1 => {}
            count => said.push(format!("it has {count} cameras: the first is used")),
        }
        if is_clipped(&model.model) {
            said.push("its camera is meant to see nothing too near or too far (znear, zfar), but here it does".into());
        }
        let exposure = exposure(&model.model);
        if !model.model.lights.is_empty() {
            said.push(format!(
                "{EXPOSED} {:.1} stops of exposure, for a white surface at the model's centre to be white; --exposure gives \
                 it others",
                stops_of(exposure)
            ));
        }
        match lit_by(&model.model) {
            LitBy::Lights => {}
            LitBy::Surfaces => said.push("its emissive surfaces light it: no sky is added".into()),
            LitBy::NextToNothing => {
                said.push("its emissive surfaces are too weak to light it: a sky and a sun are added".into());
            }
            LitBy::Nothing => said.push("it has no light: a sky and a sun are added".into()),
        }
        let animations = model.model.animations.clone();
        Ok(Self {
            path: path.into(),
            said,
            exposure,
            single_sided: false,
            animation: String::new(),
            animations,
            seconds: None,
            shutter: 0.0,
        })
    }

    /// The same with another factor of the picture's light.
    pub fn with_exposure(mut self, exposure: f64) -> Self {
        self.said.retain(|sentence| !sentence.starts_with(EXPOSED));
        Self { exposure, ..self }
    }

    /// The scene as a world, with the model at its time, or at rest.
    pub fn world(&self) -> World {
        self.world_of(self.seconds.map(|seconds| SceneTime { seconds }))
    }

    /// The scene as a world at a time of its animation, in seconds.
    ///
    /// The cameras and lights of the file move with their nodes.
    /// What pinhole adds follows from the model at rest, so that it is the same in every picture of a film: the fitted
    /// camera, the factor of all light, and the sky and the sun.
    pub fn world_at(&self, seconds: f64) -> World {
        self.world_of(Some(SceneTime { seconds }))
    }

    fn world_of(&self, time: Option<SceneTime>) -> World {
        let mut scene = World::new();
        if let Some(time) = time {
            scene.insert_resource(time);
        }
        let named = self.path.to_string_lossy().into_owned();
        let mesh = Mesh { file: named.clone(), single_sided: self.single_sided, animation: self.animation.clone() };
        let open = open_model(&scene, &named);
        // What cannot be read at the time is refused where the mesh is loaded.
        let now = if time.is_some() { open_model_now(&mut scene, &mesh) } else { open.clone() };
        let camera = now.as_ref().ok().and_then(|now| Some(spawn_camera(&mut scene, now.model.cameras.first()?)));
        let camera = camera.unwrap_or_else(|| {
            let looks = open.as_ref().map_or_else(|_| LookAt::default(), |open| fitted(&open.model));
            let fitted = PerspectiveCamera { fov: FOV, axis: FovAxis::Smaller };
            scene.spawn((Name::new("fitted camera"), fitted, looks)).id()
        });
        let sampling = Sampling { samples: 16, ..Sampling::default() };
        let resolution =
            open.as_ref().map_or_else(|_| resolution_of(None), |open| resolution_of(aspect_of(&open.model)));
        scene.entity_mut(camera).insert((resolution, sampling, Integrator::PATH));
        if let (Some(SceneTime { seconds }), true) = (time, self.shutter > 0.0) {
            scene.entity_mut(camera).insert(Shutter { open: seconds, close: seconds + self.shutter });
        }
        if self.exposure != 1.0 {
            scene.entity_mut(camera).insert(Exposure { stops: stops_of(self.exposure), automatic: false });
        }
        if let Ok(open) = &open {
            for light in &now.as_ref().unwrap_or(open).model.lights {
                spawn_light(&mut scene, light);
            }
            if matches!(lit_by(&open.model), LitBy::Nothing | LitBy::NextToNothing) {
                let sky = Gradient { bottom: Rgb::grey(0.2), top: Rgb::new(0.36, 0.46, 0.64) };
                scene.spawn((Name::new("added sky"), sky));
                let shines = LookAt { eye: DVec3::new(0.6, 1.0, 0.5), target: DVec3::ZERO, ..LookAt::default() };
                let sun = DirectionalLight { irradiance: Rgb::new(1.8, 1.7, 1.5), casts_shadows: true };
                scene.spawn((Name::new("added sun"), sun, shines));
            }
        }
        let name = self.path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        scene.spawn((mesh, Name::new(name)));
        scene.insert_resource(ModelNotes(self.said.clone()));
        load_meshes(&mut scene);
        scene.insert_resource(SceneFolder::default());
        scene
    }
}

/// Width over height of the file's first camera, if it says it.
fn aspect_of(model: &Model) -> Option<f64> {
    match model.cameras.first()?.projection {
        Projection::Perspective { aspect, .. } => aspect,
        Projection::Orthographic { xmag, ymag } => Some(xmag / ymag),
    }
}

/// Whether the clip planes of the file's first camera would leave out some vertex before it.
fn is_clipped(model: &Model) -> bool {
    let Some(camera) = model.cameras.first() else { return false };
    let matrix = camera.world_from_camera;
    let ahead = -matrix.z_axis.normalize_or_zero();
    let [near, far] = camera.clip;
    let mut depths = vertices(model).map(|at| (at - matrix.translation).dot(ahead));
    depths.any(|depth| depth > 0.0 && (depth < near || depth > far))
}

/// A picture of 640 × 360 pixels, or of about as many with another aspect ratio.
fn resolution_of(aspect: Option<f64>) -> Resolution {
    let [width, height] = [640.0, 360.0_f64];
    let aspect = aspect.filter(|aspect| aspect.is_finite()).map(|aspect| aspect.clamp(MAX_OBLONG.recip(), MAX_OBLONG));
    let [width, height] = aspect.map_or([width, height], |aspect| {
        let across = (width * height * aspect).sqrt();
        [across, across / aspect]
    });
    Resolution { width: width.round() as u32, height: height.round() as u32 }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{MeshInstance, MeshPart, Placement, SceneFile, UnreadMesh};
    use std::fs;

    /// A triangle and a camera that a node carries from the origin to (4, 0, 0) in 2 s, and a second animation in which it
    /// shrinks to nothing; beside it a triangle that stays.
    fn written(folder: &Path) -> PathBuf {
        let numbers: Vec<f32> =
            vec![0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 2., 0., 0., 0., 4., 0., 0., 1., 1., 1., 0., 0., 0.];
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        fs::write(folder.join("a.bin"), bytes).expect("written");
        let text = "{'asset':{'version':'2.0'},'buffers':[{'byteLength':92,'uri':'a.bin'}],
            'bufferViews':[{'buffer':0,'byteLength':36},{'buffer':0,'byteOffset':36,'byteLength':8},
                {'buffer':0,'byteOffset':44,'byteLength':24},{'buffer':0,'byteOffset':68,'byteLength':24}],
            'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'},
                {'bufferView':1,'componentType':5126,'count':2,'type':'SCALAR','min':[0],'max':[2]},
                {'bufferView':2,'componentType':5126,'count':2,'type':'VEC3'},
                {'bufferView':3,'componentType':5126,'count':2,'type':'VEC3'}],
            'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],
            'cameras':[{'type':'perspective','perspective':{'yfov':1,'znear':0.1}}],
            'extensions':{'KHR_lights_punctual':{'lights':[{'type':'point','intensity':10}]}},
            'nodes':[{'mesh':0,'children':[1,2]},{'camera':0,'translation':[0,0,5]},
                {'translation':[0,3,0],'extensions':{'KHR_lights_punctual':{'light':0}}}],
            'animations':[{'name':'go','samplers':[{'input':1,'output':2}],
                'channels':[{'sampler':0,'target':{'node':0,'path':'translation'}}]},
                {'name':'shrink','samplers':[{'input':1,'output':3}],
                'channels':[{'sampler':0,'target':{'node':0,'path':'scale'}}]}]}";
        fs::write(folder.join("a.gltf"), text.replace('\'', "\"")).expect("written");
        fs::write(folder.join("still.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("written");
        folder.join("a.gltf")
    }

    /// The positions of the parts of meshes.
    fn parts(world: &mut World) -> Vec<DVec3> {
        let mut query = world.query_filtered::<&Placement, (With<MeshInstance>, With<MeshPart>)>();
        query.iter(world).map(|placement| placement.position).collect()
    }

    #[test]
    fn a_model_at_a_time_moves_what_hangs_on_its_nodes_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let scene = ModelScene::open(&written(folder.path())).expect("read");
        assert_eq!(scene.animations.len(), 2);
        let seen = |mut world: World| {
            let parts = parts(&mut world);
            let camera =
                world.query_filtered::<&Placement, With<PerspectiveCamera>>().single(&world).expect("one").position;
            let light = world.query::<(&Placement, &crate::PointLight)>().single(&world).expect("one");
            (parts, camera, light.0.position, light.1.intensity)
        };
        let rest = seen(scene.world());
        assert_eq!((&rest.0[..], rest.1, rest.2), (&[DVec3::ZERO][..], DVec3::Z * 5.0, DVec3::Y * 3.0));
        for (seconds, x) in [(0.0, 0.0), (0.5, 1.0), (1.5, 3.0), (7.0, 4.0)] {
            let apart = DVec3::X * x;
            // The factor of the light follows from the model at rest, or it would change from picture to picture.
            let expected = (vec![apart], rest.1 + apart, rest.2 + apart, rest.3);
            assert_eq!(seen(scene.world_at(seconds)), expected, "{seconds}");
        }
        let shrink = ModelScene { animation: "shrink".into(), ..scene.clone() };
        assert_eq!(seen(shrink.world_at(1.0)).0, [DVec3::ZERO]);
        let mut gone = shrink.world_at(2.0);
        assert_eq!(parts(&mut gone), []);
        assert_eq!(gone.query::<&UnreadMesh>().iter(&gone).count(), 0);
        let mut unknown = ModelScene { animation: "fly".into(), ..scene }.world_at(1.0);
        let why = unknown.query::<&UnreadMesh>().single(&unknown).expect("refused").0.clone();
        let accepted =
            "the animation is \"fly\", but it must be a name (\"go\", \"shrink\"), a number from 0 to 1, or all";
        assert!(why.ends_with(accepted), "{why}");
    }

    #[test]
    fn a_scene_file_has_the_animation_that_it_names_and_shares_what_stays() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        written(folder.path());
        let text = "[(name: \"a\", mesh: (file: \"a.gltf\", animation: \"all\")), (matte: (), mesh: (file: \"still.obj\")), \
                    (perspective_camera: (), resolution: (width: 4, height: 4))]";
        let file = SceneFile::parse(&folder.path().join("s.ron"), text.into()).expect("a scene");
        let still = |world: &mut World| {
            let mut query = world.query_filtered::<&MeshInstance, With<Mesh>>();
            query.single(world).expect("the one that stays").geometry.clone()
        };
        let [mut first, mut second, mut rest] = [file.world_at(0.5), file.world_at(1.0), file.world()];
        assert!(still(&mut first).is(&still(&mut second)), "what has no animations is read once");
        let moved = |world: &mut World| {
            let mut query = world.query_filtered::<&Placement, (With<MeshPart>, Without<Mesh>)>();
            let placement = query.iter(world).find(|own| own.scale != DVec3::ZERO).expect("a part");
            (placement.position.x, placement.scale.x)
        };
        assert_eq!([&mut first, &mut second, &mut rest].map(moved), [(1.0, 0.75), (2.0, 0.5), (0.0, 1.0)]);
        let wrong = text.replace("still.obj\"", "still.obj\", animation: \"go\"");
        let mut world = SceneFile::parse(&folder.path().join("s.ron"), wrong).expect("a scene").world_at(1.0);
        let why = world.query::<&UnreadMesh>().single(&world).expect("refused").0.clone();
        assert!(why.ends_with("still.obj has no animations"), "{why}");
    }
}
