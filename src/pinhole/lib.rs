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
//! What they make public without documenting it here serves the laboratory and may change at any time:
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

#[doc(hidden)]
pub use pinhole_models as models;

#[doc(no_inline)]
pub use pinhole_scene as scene;

pub mod plan;

#[doc(hidden)]
pub mod filters;

#[doc(hidden)]
pub mod sample;

#[doc(hidden)]
pub mod material;

#[doc(hidden)]
pub mod cameras;

#[doc(hidden)]
pub mod bvh;

#[doc(hidden)]
pub mod shapes;

#[doc(hidden)]
pub mod lights;

#[doc(hidden)]
pub mod extract;

pub mod rays;

pub mod intersect;

#[doc(hidden)]
pub mod rasterise;

#[doc(hidden)]
pub mod shade;

#[doc(hidden)]
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

pub use chapter::{Chapter, Overrides, render_scene};
#[doc(hidden)]
pub use chapter::{SamplingOverrides, Size};
pub use error::{Error, Result};
#[doc(hidden)]
pub use example::run;

// The unit tests include files of the laboratory, which name this crate from outside.
/// What stands on the package's page.
#[cfg(doctest)]
#[doc = include_str!("README.md")]
struct Readme;

#[cfg(test)]
extern crate self as pinhole;
#[cfg(test)]
mod measure;
