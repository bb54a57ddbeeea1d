//! A ray tracing book you can run.
//!
//! The scene is a `bevy_ecs` world of plain components; a plan decides from them which stages exist; the stages are
//! systems that fill the columns of small tiles, one space after another, until light lands on the film.
//! The modules are listed in that order, and each uses only those above it:
//!
//! 1. [`scene`]: the components that describe a scene.
//! 2. [`plan`]: which stages the scene needs, and why.
//! 3. [`extract`]: entities → tables, as structures of arrays.
//! 4. [`sample`]: samplers, random numbers and reconstruction filters.
//! 5. [`rays`]: raster → NDC → screen → camera → world.
//! 6. [`intersect`]: rays → the closest hit and its surface.
//! 7. [`shade`]: surfaces → textures, lights and shadow rays.
//! 8. [`follow`]: paths → the next bounce, with BSDF sampling, MIS and Russian roulette.
//! 9. [`film`]: radiance → pixels → files.
//! 10. [`render`]: the loop over tiles.
//! 11. [`look`]: traces, views and statistics.
//! 12. [`stages`]: all stages, in the order of the data.

pub mod scene;

pub mod plan;

pub mod extract;

pub mod sample;

pub mod rays;

pub mod intersect;

pub mod shade;

pub mod follow;

pub mod film;

pub mod render;

pub mod look;

pub mod stages;

mod chapter;
mod error;
mod example;

pub use chapter::{Chapter, Overrides, SamplingOverrides, Size};
pub use error::{Error, Result};
pub use example::run;

// The unit tests include files of the laboratory, which name this crate from outside.
#[cfg(test)]
extern crate self as pinhole;
#[cfg(test)]
mod measure;
