//! Every chapter against its snapshots: what it computes, stage by stage, is what it computed when they were kept.
//!
//! One chapter: `cargo test --test chapters 05`.
//! What they compute otherwise now waits beside what is kept: `cargo run --release -- review` shows it, and
//! `cargo run --release -- review accept all` keeps it.

#[path = "../chapters/mod.rs"]
mod chapters;
#[path = "chapters/files.rs"]
mod files;
#[path = "chapters/message.rs"]
mod message;
#[path = "chapters/planted.rs"]
mod planted;
#[path = "chapters/png_pixels.rs"]
mod png_pixels;
#[path = "chapters/snapshots.rs"]
mod snapshots;
#[path = "chapters/waiting.rs"]
mod waiting;

/// A test for each chapter, named `chapter_` and its stem.
macro_rules! test_chapters {
    ($($test:ident: $module:ident,)+) => {
        $(#[test]
        fn $test() -> Result<(), message::Mismatch> {
            snapshots::check(&chapters::$module::chapter())
        })+

        /// The tests' names, in order.
        const TESTED: &[&str] = &[$(stringify!($test)),+];
    };
}

test_chapters! {
    chapter_cover: cover,
    chapter_01_image: image,
    chapter_02_ray: ray,
    chapter_03_hit: hit,
    chapter_04_orthographic: orthographic,
    chapter_05_pinhole: pinhole_camera,
    chapter_06_ndc: ndc,
    chapter_07_screen: screen,
    chapter_08_field_of_view: field_of_view,
    chapter_09_camera_to_world: camera_to_world,
    chapter_10_light_and_shadow: light_and_shadow,
    chapter_11_conventions: conventions,
    chapter_12_how_it_is_built: how_it_is_built,
    chapter_13_shapes: shapes,
    chapter_14_transforms: transforms,
    chapter_15_reflection: reflection,
    chapter_16_textures: textures,
    chapter_17_sampling: sampling,
    chapter_18_error_and_time: error_and_time,
    chapter_19_mirrors: mirrors,
    chapter_20_glass: glass,
    chapter_21_soft_shadows: soft_shadows,
    chapter_22_ambient_occlusion: ambient_occlusion,
    chapter_23_depth_of_field: depth_of_field,
    chapter_24_motion_blur: motion_blur,
    chapter_25_path_tracing: path_tracing,
    chapter_26_choosing_samples: choosing_samples,
    chapter_27_caustics: caustics,
}

#[test]
fn every_chapter_has_its_test() {
    let expected: Vec<String> = chapters::all().iter().map(|chapter| format!("chapter_{}", chapter.name)).collect();
    assert!(
        expected == TESTED,
        "chapters/mod.rs and the list in tests/chapters.rs do not agree: the tests must be {expected:?}, in this order"
    );
}

#[test]
fn every_snapshot_file_is_there_and_none_is_unused() -> Result<(), message::Mismatch> {
    let names: Vec<&str> = chapters::all().iter().map(|chapter| chapter.name).collect();
    files::check(&names)
}
