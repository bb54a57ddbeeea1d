//! The description of a scene: plain components in f64, every field with a default.
//!
//! Nothing here computes a picture.
//! A scene is a `bevy_ecs` world of these components; `plan` looks at which of them exist, and `extract` turns them
//! into the tables that the stages read.
//!
//! Spaces: right-handed, y up; a camera looks down its own −z with +x to the right of the image.
//! Units: lengths in scene units, angles in [`Degrees`], colours in linear Rec. 709.
//!
//! ```
//! use bevy_ecs::prelude::*;
//! use pinhole_scene::*;
//!
//! let mut scene = World::new();
//! let room = scene.spawn((Name::new("room"), Placement::at(0.0, 0.0, -10.0))).id();
//! scene.spawn((Sphere { radius: 2.0 }, Glass::default(), ChildOf(room)));
//! scene.spawn((PerspectiveCamera { fov: Degrees(60.0), ..PerspectiveCamera::default() }, Sampling::default()));
//! assert_eq!(scene.query::<&Sphere>().iter(&scene).count(), 1);
//! ```

mod cameras;
mod check;
mod colour;
mod density_grid;
mod dispersion;
mod exposure;
mod file;
mod file_store;
mod folder;
mod image_kind;
mod integrator;
mod keys;
mod lights;
mod material;
mod medium;
mod memory;
mod model;
mod named_files;
mod open_file;
mod picture;
mod placement;
mod printable;
mod scene_error;
mod shapes;
mod sky;
mod textures;

#[doc(no_inline)]
pub use bevy_ecs::entity_disabling::Disabled;
#[doc(no_inline)]
pub use bevy_ecs::hierarchy::ChildOf;
#[doc(no_inline)]
pub use bevy_ecs::name::Name;
pub use cameras::{
    Aperture, EquirectangularCamera, FisheyeCamera, FovAxis, Lens, OrthographicCamera, PerspectiveCamera,
};
#[doc(hidden)]
pub use check::{colour_within, finite_point, light_colour, number, positive_length, triple};
pub use colour::Rgb;
pub use density_grid::DensityGrid;
#[doc(hidden)]
pub use density_grid::{DENSITY_FILE, MAX_VOXELS};
#[doc(hidden)]
pub use dispersion::Dispersion;
pub use exposure::{Exposure, ToneMapping};
#[doc(hidden)]
pub use file::FileProblem;
pub use file::SceneFile;
#[doc(hidden)]
pub use file::{FNV_BASIS, PlaceInFile, fingerprint, fnv, in_words_of_files, scene_text, words};
#[doc(hidden)]
pub use file_store::{FileStore, Undecoded};
#[doc(hidden)]
pub use folder::{EmbeddedFiles, SceneFolder};
#[doc(no_inline)]
pub use glam::DQuat;
#[doc(hidden)]
pub use image_kind::{KINDS_READ, TELLING_BYTES, image_kind};
#[doc(hidden)]
pub use integrator::LightTransport;
pub use integrator::{Integrator, LightStrategy};
#[doc(hidden)]
pub use keys::smooth;
pub use keys::{KeyCurve, KeyedValues, Keys};
pub use lights::{DirectionalLight, Emissive, PointLight, Sides, SpotLight};
#[doc(hidden)]
pub use material::UsedByShapes;
pub use material::{BlinnPhong, Glass, Matte, Metal, Mirror, Phong, Principled, RoughGlass, ThinGlass, UsesMaterial};
pub use medium::Medium;
#[doc(hidden)]
pub use memory::{TooLittleMemory, check_memory, check_workers, in_words};
#[doc(hidden)]
pub use model::{
    MODEL_FILE, MeshInMemory, MeshPart, ModelFiles, ModelNotes, ModelScene, SceneTime, UnreadMesh, animates_after,
    is_model_file, meshes_in_memory,
};
pub use model::{Mesh, load_meshes};
#[doc(hidden)]
pub use named_files::{for_each_file_name, named_files};
#[doc(hidden)]
pub use open_file::{FileError, FileKind, OpenFile, Unopened, open_file, opened_files, read_file};
pub use picture::{
    Adaptive, BidirectionalPathTracing, Filter, Layers, LightTracing, PhotonMapping, Rasterisation, Resolution,
    Sampler, Sampling, Statistics, View,
};
#[doc(hidden)]
pub use picture::{LayerKind, OPEN_END, TracePixel};
#[doc(hidden)]
pub use pinhole_models::is_invisible;
pub use placement::{Degrees, LookAt, Motion, Placement, Shutter};
#[doc(hidden)]
pub use placement::{axis_angle, called, euler_xyz, some_of};
#[doc(hidden)]
pub use printable::{printable, printable_message, printable_path};
pub use scene_error::SceneError;
pub use shapes::{Cone, Cuboid, Cylinder, Disk, MeshInstance, Plane, Sphere, Torus, Triangle};
#[doc(hidden)]
pub use shapes::{MeshGeometry, Rectangle};
pub use sky::{Background, Environment, Gradient};
pub use textures::{
    Checker, EmissionMap, ImageTexture, NormalMap, Opacity, OpacityChannel, OpacityMap, SingleSided, Stripes,
};
#[doc(hidden)]
pub use textures::{Feeds, IMAGE_FILE, MetallicRoughnessMap, Texture, TextureBy, Tint, UvTransform, Wrap, WrapMode};
use textures::{change_texture_files, texture_files};

// The random numbers of unit tests are the laboratory's.
#[cfg(test)]
#[allow(dead_code, reason = "the laboratory uses the rest")]
#[path = "../lab/measure/draws.rs"]
mod draws;
