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

#[path = "06_ndc/main.rs"]
pub mod ndc;

#[path = "07_screen/main.rs"]
pub mod screen;

#[path = "08_field_of_view/main.rs"]
pub mod field_of_view;

#[path = "09_camera_to_world/main.rs"]
pub mod camera_to_world;

#[path = "10_light_and_shadow/main.rs"]
pub mod light_and_shadow;

#[path = "11_conventions/main.rs"]
pub mod conventions;

#[path = "12_how_it_is_built/main.rs"]
pub mod how_it_is_built;

/// All chapters, the cover first.
pub fn all() -> Vec<Chapter> {
    vec![
        cover::chapter(),
        image::chapter(),
        ray::chapter(),
        hit::chapter(),
        orthographic::chapter(),
        pinhole_camera::chapter(),
        ndc::chapter(),
        screen::chapter(),
        field_of_view::chapter(),
        camera_to_world::chapter(),
        light_and_shadow::chapter(),
        conventions::chapter(),
        how_it_is_built::chapter(),
    ]
}
