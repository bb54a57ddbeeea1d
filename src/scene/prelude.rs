//! What describes a scene: its components, and what their fields are.
//!
//! Space: that of each component's placement.

pub use crate::cameras::{
    Aperture, EquirectangularCamera, FisheyeCamera, FovAxis, Lens, OrthographicCamera, PerspectiveCamera,
};
pub use crate::colour::Rgb;
pub use crate::density_grid::DensityGrid;
pub use crate::dispersion::Dispersion;
pub use crate::exposure::{Exposure, ToneMapping};
pub use crate::file::SceneFile;
pub use crate::integrator::{Integrator, LightStrategy, LightTransport};
pub use crate::keys::{KeyCurve, KeyedValues, Keys};
pub use crate::lights::{DirectionalLight, Emissive, PointLight, Sides, SpotLight};
pub use crate::material::{
    BlinnPhong, Glass, Matte, Metal, Mirror, Phong, Principled, RoughGlass, ThinGlass, UsesMaterial,
};
pub use crate::medium::Medium;
pub use crate::model::{Mesh, load_meshes};
pub use crate::picture::{
    Adaptive, BidirectionalPathTracing, Filter, LayerKind, Layers, LightTracing, PhotonMapping, Rasterisation,
    Resolution, Sampler, Sampling, Statistics, TracePixel, View,
};
pub use crate::placement::{Degrees, LookAt, Motion, Placement, Shutter, axis_angle};
pub use crate::scene_error::SceneError;
pub use crate::shapes::{
    Cone, Cuboid, Cylinder, Disk, MeshGeometry, MeshInstance, Plane, Rectangle, Sphere, Torus, Triangle,
};
pub use crate::sky::{Background, Environment, Gradient};
pub use crate::textures::{
    Checker, EmissionMap, Feeds, ImageTexture, MetallicRoughnessMap, NormalMap, Opacity, OpacityChannel, OpacityMap,
    SingleSided, Stripes, Texture, TextureBy, Tint, UvTransform, Wrap, WrapMode,
};
#[doc(no_inline)]
pub use bevy_ecs::entity_disabling::Disabled;
#[doc(no_inline)]
pub use bevy_ecs::hierarchy::ChildOf;
#[doc(no_inline)]
pub use bevy_ecs::name::Name;
#[doc(no_inline)]
pub use glam::DQuat;
