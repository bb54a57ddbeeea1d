//! A shape, a material, a texture, a light or a stage of your own, from a crate of your own: nothing of this one is changed.
//!
//! Each is a type that implements one trait of those below: [`Shape`], [`Bsdf`], [`Pattern`], [`Light`].
//! A macro gives it a kind and names ([`custom_shape!`], [`custom_bsdf!`], [`custom_light!`]); a scene says that it may have
//! it (`add_…`); and its stages are offered beside those of the library (`of_…`), compiled for it alone.
//! The plan keeps what a scene needs, as of everything else.
//!
//! A texture, whole; `tests/outside` has one of each:
//!
//! ```
//! use pinhole::extend::*;
//! use pinhole::prelude::*;
//!
//! /// Colours that change along a shape's own x.
//! #[derive(Component, Clone, Debug, Default, PartialEq)]
//! struct Ramp;
//!
//! impl Texture for Ramp {
//!     const WORD: &'static str = "ramp";
//!     const NOUN: &'static str = "material with a ramp";
//!     const PATTERN: &'static str = "ramp";
//!     const FEEDS: Feeds = Feeds::Colour;
//!     fn by(&self) -> TextureBy {
//!         TextureBy::Space
//!     }
//!     fn is_filtered(&self) -> bool {
//!         false
//!     }
//! }
//!
//! impl Pattern for Ramp {
//!     const TABLE: &'static str = "ramps";
//!     const STAGE: &'static str = "Evaluate textures: ramps";
//!     fn albedos(&self) -> Vec<(&'static str, Rgb)> {
//!         vec![("brightest", Rgb::grey(1.0))]
//!     }
//!     fn colour(&self, at: &TexturePoint) -> [f64; 3] {
//!         [at.point.x.clamp(0.0, 1.0), 0.5, 0.5]
//!     }
//! }
//!
//! let mut scene = World::new();
//! add_texture::<Ramp>(&mut scene);
//! scene.spawn((PerspectiveCamera::default(), Resolution { width: 16, height: 9 }));
//! scene.spawn((Sphere::default(), Placement::at(0.0, 0.0, -3.0), Matte::default(), Ramp));
//! scene.spawn((PointLight { intensity: Rgb::grey(20.0), ..PointLight::default() }, Placement::at(0.0, 0.0, 1.0)));
//! let film = render(&scene, &every_stage_and([of_texture::<Ramp>()]), &Execution::default(), &())?.film;
//! let [left, right] = [film.mean(6, 4), film.mean(9, 4)];
//! assert!(left[0] < right[0] && (left[1] - right[1]).abs() < 1e-3);
//! # Ok::<(), pinhole::Error>(())
//! ```

pub use crate::chapter::every_stage_and;
pub use crate::extract::{Pattern, TexturePoint, add_light, add_shape, add_texture, eye};
pub use crate::lights::{
    Light, LightBounds, LightSample, LightStart, PlacedLight, SceneLight, StartDraws, Targets, custom_light,
    direction_to_targets, luminance,
};
pub use crate::material::{
    Bsdf, BsdfClass, BsdfSample, Example, Interior, MaterialKind, Named, Parameters, ShadingContext, SpecularSample,
    Transport, add_material, custom_bsdf, entities_of_kind,
};
pub use crate::plan::{VectorRows, VectorRowsMut, column};
pub use crate::render::{Inspection, RenderInProgress, Watch, inspect, render};
pub use crate::scene::{Feeds, Texture, TextureBy};
pub use crate::shade::{Radiance, SurfaceColours};
pub use crate::shapes::emitter::{NeverSampled, sphere_direction};
pub use crate::shapes::{
    Bounds, Intersection, Placed, Pose, RayHit, SceneShape, Shape, SurfacePoint, UvSlope, custom_shape, l1_norm,
    normal_world_from_object,
};
pub use crate::stages::{of_light, of_material, of_shape, of_texture};
