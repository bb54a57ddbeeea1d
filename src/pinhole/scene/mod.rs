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
//! use pinhole::prelude::*;
//!
//! let mut scene = World::new();
//! let room = scene.spawn((Name::new("room"), Placement::at(0.0, 0.0, -10.0))).id();
//! scene.spawn((Sphere { radius: 2.0 }, Glass::default(), ChildOf(room)));
//! scene.spawn((PerspectiveCamera { fov: Degrees(60.0), ..PerspectiveCamera::default() }, Sampling::default()));
//! assert_eq!(scene.query::<&Sphere>().iter(&scene).count(), 1);
//! ```

mod adaptive;
mod angle;
mod background;
mod camera;
mod check;
mod checker;
mod colour;
mod cone;
mod cuboid;
mod cylinder;
mod directional_light;
mod disk;
mod emission_map;
mod emissive;
mod environment;
mod equirectangular;
mod file;
mod file_store;
mod filter;
mod fisheye;
mod folder;
mod gradient;
mod image_kind;
mod image_texture;
mod integrator;
mod layers;
mod lens;
mod light_tracing;
mod material;
mod memory;
mod mesh_instance;
mod metallic_roughness_map;
mod model;
mod motion;
mod name;
mod normal_map;
mod opacity;
mod open_file;
mod orientation;
mod placement;
mod plane;
mod point_light;
mod printable;
mod rasterisation;
mod rectangle;
mod request;
mod resolution;
mod sampling;
mod scene_error;
mod sphere;
mod spot_light;
mod stripes;
mod texture;
mod textures;
mod tint;
mod torus;
mod triangle;

pub use adaptive::Adaptive;
#[doc(hidden)]
pub use adaptive::OPEN_END;
pub use angle::Degrees;
pub use background::Background;
#[doc(no_inline)]
pub use bevy_ecs::entity_disabling::Disabled;
#[doc(no_inline)]
pub use bevy_ecs::hierarchy::ChildOf;
#[doc(no_inline)]
pub use bevy_ecs::name::Name;
pub use camera::{FovAxis, OrthographicCamera, PerspectiveCamera};
pub(crate) use check::{colour_within, finite_point, light_colour, number, positive_length, triple};
pub use checker::Checker;
pub use colour::Rgb;
pub use cone::Cone;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use directional_light::DirectionalLight;
pub use disk::Disk;
pub use emission_map::EmissionMap;
pub use emissive::{Emissive, Sides};
pub use environment::Environment;
pub use equirectangular::EquirectangularCamera;
#[doc(hidden)]
pub use file::FileProblem;
pub use file::SceneFile;
#[doc(hidden)]
pub use file::{FNV_BASIS, PlaceInFile, fingerprint, fnv, in_words_of_files, scene_text, words};
#[doc(hidden)]
pub use file_store::{FileStore, Undecoded};
pub use filter::Filter;
pub use fisheye::FisheyeCamera;
#[doc(hidden)]
pub use folder::{EmbeddedFiles, SceneFolder};
#[doc(no_inline)]
pub use glam::DQuat;
pub use gradient::Gradient;
#[doc(hidden)]
pub use image_kind::{KINDS_READ, TELLING_BYTES, image_kind};
#[doc(hidden)]
pub use image_texture::IMAGE_FILE;
pub use image_texture::ImageTexture;
#[doc(hidden)]
pub use integrator::LightTransport;
pub use integrator::{Integrator, LightStrategy};
#[doc(hidden)]
pub use layers::LayerKind;
pub use layers::Layers;
pub use lens::{Aperture, Lens};
pub use light_tracing::LightTracing;
pub use material::*;
#[doc(hidden)]
pub use memory::{TooLittleMemory, check_memory, check_workers, in_words};
#[doc(hidden)]
pub use mesh_instance::MeshGeometry;
pub use mesh_instance::MeshInstance;
#[doc(hidden)]
pub use metallic_roughness_map::MetallicRoughnessMap;
#[doc(hidden)]
pub use model::{
    MODEL_FILE, MeshInMemory, MeshPart, ModelFiles, ModelNotes, ModelScene, UnreadMesh, is_model_file, meshes_in_memory,
};
pub use model::{Mesh, load_meshes};
pub use motion::{Motion, Shutter};
#[doc(hidden)]
pub use name::{called, some_of};
pub use normal_map::NormalMap;
pub use opacity::{Opacity, OpacityChannel, OpacityMap, SingleSided};
#[doc(hidden)]
pub use open_file::{FileError, FileKind, OpenFile, Unopened, open_file, read_file};
#[doc(hidden)]
pub use orientation::{axis_angle, euler_xyz};
#[doc(hidden)]
pub use pinhole_models::is_invisible;
pub use placement::{LookAt, Placement};
pub use plane::Plane;
pub use point_light::PointLight;
#[doc(hidden)]
pub use printable::{printable, printable_message, printable_path};
pub use rasterisation::Rasterisation;
#[doc(hidden)]
pub use rectangle::Rectangle;
pub use request::Statistics;
#[doc(hidden)]
pub use request::TracePixel;
pub use request::View;
pub use resolution::Resolution;
pub use sampling::{Sampler, Sampling};
pub use scene_error::SceneError;
pub use sphere::Sphere;
pub use spot_light::SpotLight;
pub use stripes::Stripes;
#[doc(hidden)]
#[doc(hidden)]
pub use texture::{Feeds, Texture, TextureBy, UvTransform, Wrap, WrapMode};
pub(crate) use textures::for_each_texture;
#[doc(hidden)]
pub use textures::{for_each_texture_file, texture_files};
#[doc(hidden)]
pub use tint::Tint;
pub use torus::Torus;
pub use triangle::Triangle;
