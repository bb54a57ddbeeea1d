//! The textbook methods that break, kept so that the book and `extremes` can show how.
//!
//! Reads: f32 rays and shapes, in world space unless a function says otherwise. Writes: what the
//! textbook would. No render ever uses anything from here.

pub mod camera;
pub mod entity_per_ray;
pub mod plane;
pub mod shadow;
pub mod sphere;
