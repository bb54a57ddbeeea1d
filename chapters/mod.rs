//! The chapters in order: one list for the command line, the tests and the book.
#![allow(dead_code, reason = "each chapter is also an example with a main of its own")]

use pinhole::Chapter;

#[path = "cover/main.rs"]
pub mod cover;

#[path = "01_image/main.rs"]
pub mod image;

#[path = "02_ray/main.rs"]
pub mod ray;

#[path = "03_hit/main.rs"]
pub mod hit;

#[path = "04_orthographic/main.rs"]
pub mod orthographic;

#[path = "05_pinhole/main.rs"]
pub mod pinhole_camera;

/// All chapters, the cover first.
pub fn all() -> Vec<Chapter> {
    vec![
        cover::chapter(),
        image::chapter(),
        ray::chapter(),
        hit::chapter(),
        orthographic::chapter(),
        pinhole_camera::chapter(),
    ]
}
