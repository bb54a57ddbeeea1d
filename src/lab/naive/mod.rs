//! The textbook methods that break, kept so that the book and `extremes` can show how.
//!
//! Reads: f32 rays and shapes, in world space unless a function says otherwise. Writes: what the
//! textbook would. No chapter's render uses anything from here; figures show what would have come of it.

pub mod adaptive;
pub mod both;
pub mod boxes;
pub mod camera;
pub mod caustics;
pub mod coverage;
pub mod cuboid;
pub mod denoise;
pub mod ellipsoid;
pub mod emitter;
pub mod entity_per_ray;
pub mod error;
pub mod euler;
pub mod field_of_view;
pub mod film;
pub mod lens;
pub mod light;
pub mod material;
pub mod mesh;
pub mod methods;
pub mod mistake;
mod monte_carlo;
pub mod ndc;
pub mod one_page;
pub mod path;
pub mod planar;
pub mod plane;
pub mod projection;
pub mod rasterise;
pub mod rows;
pub mod sampling;
pub mod screen;
pub mod shadow;
pub mod sphere;
pub mod stages;
pub mod texture;
pub mod tree;
pub mod triangle;
pub mod ways;
pub mod wide;
