//! What an author writes: plain components, in f64, with defaults in place.
//!
//! Nothing here computes a picture.
//! A scene is a `bevy_ecs` world of these components; `plan` reads which of them there are, and `extract` turns
//! them into the tables that the stages read.
//!
//! Spaces: right-handed, y up; a camera looks down its own −z with +x to the right of the image.
//! Units: lengths in scene units, angles in [`Degrees`], colours in linear Rec. 709.

mod adaptive;
mod angle;
mod background;
mod camera;
mod colour;
mod cuboid;
mod disk;
mod file;
mod filter;
mod layers;
mod matte;
mod name;
mod placement;
mod plane;
mod point_light;
mod rectangle;
mod refusal;
mod request;
mod resolution;
mod sampling;
mod sphere;
mod triangle;

pub use adaptive::Adaptive;
pub use angle::Degrees;
pub use background::Background;
pub use bevy_ecs::entity_disabling::Disabled;
pub use bevy_ecs::hierarchy::ChildOf;
pub use bevy_ecs::name::Name;
pub use camera::{FovAxis, OrthographicCamera, PerspectiveCamera};
pub use colour::Rgb;
pub use cuboid::Cuboid;
pub use disk::Disk;
pub use file::{FileProblem, PlaceInFile, SceneFile, scene_text, words};
pub use filter::Filter;
pub use glam::DQuat;
pub use layers::{LayerKind, Layers};
pub use matte::{Matte, UsedByShapes, UsesMaterial};
pub use name::called;
pub use placement::{LookAt, Placement};
pub use plane::Plane;
pub use point_light::PointLight;
pub use rectangle::Rectangle;
pub use refusal::Refusal;
pub use request::{Statistics, TracePixel, View};
pub use resolution::Resolution;
pub use sampling::{Sampler, Sampling};
pub use sphere::Sphere;
pub use triangle::Triangle;
