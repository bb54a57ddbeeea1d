//! A data-oriented ray tracing renderer: scenes of plain `bevy_ecs` components, a plan, and stages that fill columns.
//!
//! A matte ball on the ground, lit from the upper left, as letters that grow darker with the light:
//!
//! ```
//! use pinhole::prelude::*;
//!
//! let mut scene = World::new();
//! scene.spawn((
//!     PerspectiveCamera { fov: Degrees(28.0), axis: FovAxis::Vertical },
//!     LookAt { eye: [0.0, 1.6, 6.0].into(), target: [0.0, 0.9, 0.0].into(), ..LookAt::default() },
//!     Resolution { width: 56, height: 16 },
//! ));
//! scene.spawn((Sphere { radius: 1.0 }, Placement::at(0.0, 1.0, 0.0), Matte { colour: Rgb::grey(0.9) }));
//! scene.spawn((Plane::default(), Matte { colour: Rgb::grey(0.35) }));
//! let light = PointLight { intensity: Rgb::grey(120.0), ..PointLight::default() };
//! scene.spawn((light, Placement::at(-4.0, 5.0, 3.0)));
//!
//! let film = render_scene(&scene)?.film;
//! let letter = |x, y| b" .:-=+*#%@"[(film.mean(x, y)[0] * 9.0).min(9.0) as usize] as char;
//! let picture: Vec<String> = (0..16).map(|y| (0..56).map(|x| letter(x, y)).collect()).collect();
//! assert_eq!(picture, [
//!     "                                                        ",
//!     "                                                        ",
//!     "                          %#+-                          ",
//!     "                        @@%#+=:                         ",
//!     "                       @@@%*+=:                         ",
//!     "                       @@%#*=-:                         ",
//!     "                       %%#*+-:.                         ",
//!     "                       #**+=:.                          ",
//!     "                       ++=-:.                           ",
//!     "            ......     ---:.                            ",
//!     "........................:..                             ",
//!     ".::::::::::::::::::.....                                ",
//!     "::::::::::::::::::::::::.                               ",
//!     "---------------:::::::::::..      .......               ",
//!     "------------------::::::::::................            ",
//!     "========-----------:::::::::::................          ",
//! ]);
//! # Ok::<(), pinhole::Error>(())
//! ```
//!
//! The scene is a `bevy_ecs` world of plain components; a plan decides from them which stages exist; the stages are
//! systems that fill the columns of small tiles, one space after another, until light lands on the film.
//! Another crate can add a shape, a material, a texture, a light or a stage: [`extend`] begins with one, whole.
//! The modules are listed in that order, and each uses only those above it.
//! What is public with the feature `unstable` alone serves the laboratory, and nothing in it is stable:
//!
//! 1. [`scene`]: the components that describe a scene.
//! 2. [`plan`]: which stages the scene needs, and why.
//! 3. [`filters`]: what a reconstruction filter is, and how each is sampled.
//! 4. [`sample`]: samplers and random numbers.
//! 5. [`material`]: how surfaces scatter light, one file for each BSDF.
//! 6. [`cameras`]: what a camera is, and the mathematics of each.
//! 7. [`bvh`]: bounding volume hierarchies, and rays through them.
//! 8. [`shapes`]: what a shape is, and the mathematics of each.
//! 9. [`lights`]: what a light without an area is, and the mathematics of each.
//! 10. [`extract`]: entities → tables, as structures of arrays.
//! 11. [`rays`]: raster → NDC → screen → camera → world.
//! 12. [`intersect`]: rays → the closest hit and its surface.
//! 13. [`rasterise`]: triangles and boxes → the same hits, in the other order.
//! 14. [`shade`]: surfaces → textures, lights and shadow rays.
//! 15. [`follow`]: paths → the next bounce, with BSDF sampling, MIS and Russian roulette.
//! 16. [`film`]: radiance → pixels → files.
//! 17. [`render`]: the loop over tiles.
//! 18. [`look`]: traces, views and statistics.
//! 19. [`stages`]: all stages, in the order of the data.
//! 20. [`prelude`]: what a scene or a stage of one's own begins with.
//! 21. [`extend`]: a shape, a material, a texture, a light or a stage of one's own, from another crate.

#![cfg_attr(
    not(feature = "unstable"),
    allow(dead_code, unused_imports, reason = "the laboratory and the program use the rest"),
    allow(rustdoc::private_intra_doc_links, reason = "what is documented says what it is made of")
)]

#[cfg(feature = "unstable")]
pub use pinhole_models as models;
#[cfg(not(feature = "unstable"))]
use pinhole_models as models;

#[cfg(feature = "unstable")]
#[macro_use(unstable)]
pub extern crate pinhole_scene as scene;
#[cfg(not(feature = "unstable"))]
#[macro_use(unstable)]
extern crate pinhole_scene as scene;

pub mod plan;

// Each twice, since rustfmt follows no `mod` that a macro writes.
#[cfg(not(feature = "unstable"))]
mod filters;
#[cfg(feature = "unstable")]
pub mod filters;

#[cfg(not(feature = "unstable"))]
mod sample;
#[cfg(feature = "unstable")]
pub mod sample;

#[cfg(not(feature = "unstable"))]
mod material;
#[cfg(feature = "unstable")]
pub mod material;

#[cfg(not(feature = "unstable"))]
mod cameras;
#[cfg(feature = "unstable")]
pub mod cameras;

#[cfg(not(feature = "unstable"))]
mod bvh;
#[cfg(feature = "unstable")]
pub mod bvh;

#[cfg(not(feature = "unstable"))]
mod shapes;
#[cfg(feature = "unstable")]
pub mod shapes;

#[cfg(not(feature = "unstable"))]
mod lights;
#[cfg(feature = "unstable")]
pub mod lights;

#[cfg(not(feature = "unstable"))]
mod extract;
#[cfg(feature = "unstable")]
pub mod extract;

pub mod rays;

pub mod intersect;

#[cfg(not(feature = "unstable"))]
mod rasterise;
#[cfg(feature = "unstable")]
pub mod rasterise;

#[cfg(not(feature = "unstable"))]
mod shade;
#[cfg(feature = "unstable")]
pub mod shade;

#[cfg(not(feature = "unstable"))]
mod follow;
#[cfg(feature = "unstable")]
pub mod follow;

pub mod film;

pub mod render;

pub mod look;

pub mod stages;

pub mod prelude;

pub mod extend;

mod chapter;
mod check;
mod each;
mod error;
mod example;

pub use chapter::{Chapter, Overrides, SamplingOverrides, Size, render_scene};
pub use error::{Error, Result};

/// What the macros for another crate's shapes, materials and lights name.
#[doc(hidden)]
pub mod named {
    pub use crate::lights::{AnyLight, LightNames, ListedLight};
    pub use crate::material::{Bsdf, MaterialKind, Named, StageNames};
    pub use crate::shapes::{AnyShape, Emitter, Listed, Shape, ShapeKind, ShapeNames};
}
unstable! { use example::run; }

// The unit tests include files of the laboratory, which name this crate from outside.
/// What stands on the package's page.
#[cfg(doctest)]
#[doc = include_str!("README.md")]
struct Readme;

#[cfg(test)]
extern crate self as pinhole;
#[cfg(test)]
mod measure;
