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

#[path = "13_shapes/main.rs"]
pub mod shapes;

#[path = "14_transforms/main.rs"]
pub mod transforms;

#[path = "15_reflection/main.rs"]
pub mod reflection;

#[path = "16_textures/main.rs"]
pub mod textures;

#[path = "17_sampling/main.rs"]
pub mod sampling;

#[path = "18_error_and_time/main.rs"]
pub mod error_and_time;

#[path = "19_mirrors/main.rs"]
pub mod mirrors;

#[path = "20_glass/main.rs"]
pub mod glass;

#[path = "21_soft_shadows/main.rs"]
pub mod soft_shadows;

#[path = "22_ambient_occlusion/main.rs"]
pub mod ambient_occlusion;

#[path = "23_depth_of_field/main.rs"]
pub mod depth_of_field;

#[path = "24_motion_blur/main.rs"]
pub mod motion_blur;

#[path = "25_path_tracing/main.rs"]
pub mod path_tracing;

#[path = "26_choosing_samples/main.rs"]
pub mod choosing_samples;

#[path = "27_caustics/main.rs"]
pub mod caustics;

pub mod exercises;

/// All chapters, the cover first.
pub fn all() -> Vec<Chapter> {
    vec![
        cover::chapter(),
        image::chapter().exercise(exercises::IMAGE),
        ray::chapter().exercise(exercises::RAY),
        hit::chapter().exercise(exercises::HIT),
        orthographic::chapter().exercise(exercises::ORTHOGRAPHIC),
        pinhole_camera::chapter().exercise(exercises::PINHOLE_CAMERA),
        ndc::chapter().exercise(exercises::NDC),
        screen::chapter().exercise(exercises::SCREEN),
        field_of_view::chapter().exercise(exercises::FIELD_OF_VIEW),
        camera_to_world::chapter().exercise(exercises::CAMERA_TO_WORLD),
        light_and_shadow::chapter().exercise(exercises::LIGHT_AND_SHADOW),
        conventions::chapter().exercise(exercises::CONVENTIONS),
        how_it_is_built::chapter().exercise(exercises::HOW_IT_IS_BUILT),
        shapes::chapter().exercise(exercises::SHAPES),
        transforms::chapter().exercise(exercises::TRANSFORMS),
        reflection::chapter().exercise(exercises::REFLECTION),
        textures::chapter().exercise(exercises::TEXTURES),
        sampling::chapter().exercise(exercises::SAMPLING),
        error_and_time::chapter().exercise(exercises::ERROR_AND_TIME),
        mirrors::chapter().exercise(exercises::MIRRORS),
        glass::chapter().exercise(exercises::GLASS),
        soft_shadows::chapter().exercise(exercises::SOFT_SHADOWS),
        ambient_occlusion::chapter().exercise(exercises::AMBIENT_OCCLUSION),
        depth_of_field::chapter().exercise(exercises::DEPTH_OF_FIELD),
        motion_blur::chapter().exercise(exercises::MOTION_BLUR),
        path_tracing::chapter().exercise(exercises::PATH_TRACING),
        choosing_samples::chapter().exercise(exercises::CHOOSING_SAMPLES),
        caustics::chapter().exercise(exercises::CAUSTICS),
    ]
}
