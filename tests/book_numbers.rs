//! The numbers and sentences that stand in a page as text are computed here, and must stand there as computed.

use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use pinhole::extract::validate;
use pinhole::film::{Curve, byte_from_linear, linear_from_srgb};
use pinhole::rays::WorldRays;
use pinhole::render::inspect;
use pinhole::scene::*;
use pinhole::{Asked, Chapter};
use std::path::Path;

#[path = "../chapters/mod.rs"]
mod chapters;
#[path = "book_numbers/spaces.rs"]
mod spaces;

fn chapter(name: &str) -> Chapter {
    chapters::all().into_iter().find(|chapter| chapter.name == name).expect("a chapter")
}

#[track_caller]
fn page_says(page: &str, sentence: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("book/src").join(page);
    let text = std::fs::read_to_string(path).expect("the page can be read");
    assert!(text.contains(sentence), "book/src/{page} must say:\n{sentence}");
}

/// How far the naive sum of steps has drifted at the last pixel's left edge, in pixels.
fn drift(width: u32) -> f64 {
    let (step, mut x) = (1.0 / width as f32, 0.0_f32);
    for _ in 1..width {
        x += step;
    }
    f64::from(x) * f64::from(width) - f64::from(width - 1)
}

#[test]
fn the_naive_loop_over_pixels_drifts_as_page_01_says() {
    for (width, shown) in [(480, "480"), (1920, "1,920"), (60_000, "60,000"), (65_535, "65,535")] {
        let drift = drift(width);
        let decimals = if drift.abs() < 1.0 { format!("{drift:.3}") } else { format!("{drift:.0}") };
        page_says("01_image.md", &format!("| {shown} | {} |", decimals.replace('-', "−")));
    }
    assert_eq!(drift(65_536), 0.0);
}

#[test]
fn the_naive_loop_goes_round_once_too_often_as_page_01_says() {
    let (mut x32, mut x64, mut turns) = (0.0_f32, 0.0_f64, [0_u32; 2]);
    while x32 < 1.0 {
        x32 += 1.0 / 1920.0;
        turns[0] += 1;
    }
    while x64 < 1.0 {
        x64 += 1.0 / 1920.0;
        turns[1] += 1;
    }
    assert_eq!(turns, [1921, 1921]);
    page_says("01_image.md", "goes round 1,921 times, in f32 and in f64");
}

#[test]
fn light_and_bytes_are_as_page_01_says() {
    let byte = |light| byte_from_linear(light, Curve::Srgb);
    page_says("01_image.md", &format!("Half the light is byte {}.", byte(0.5)));
    page_says("01_image.md", &format!("about a fifth ({:.3}) of the light", linear_from_srgb(128.0 / 255.0)));
    let [dark, light] = [25.0, 26.0].map(|byte| linear_from_srgb(byte / 255.0));
    assert!(dark < 0.01 && 0.01 < light);
    page_says(
        "01_image.md",
        &format!("while sRGB has 25 and 26, which are {:.0} % apart", (light / dark - 1.0) * 100.0),
    );
}

#[test]
fn lengths_that_f32_cannot_square_are_as_page_02_says() {
    let none = |v: Vec3| v.try_normalize().is_none();
    assert!(none(Vec3::ZERO) && Vec3::ZERO.normalize().is_nan());
    let small = Vec3::new(1e-23, 0.0, 0.0);
    assert!(none(small) && small.length() == 0.0 && small.normalize().x == f32::INFINITY);
    let large = Vec3::new(2e19, 0.0, 0.0);
    assert!(none(large) && large.length() == f32::INFINITY && large.normalize() == Vec3::ZERO);
    let long = Vec3::new(0.0, 0.0, 1e-22);
    let row = format!("| (0, 0, 1e-22) | {:.3e} | (0, 0, {:.4}) |", long.length(), long.normalize().z);
    page_says("02_ray.md", &row);
}

#[test]
fn directions_are_as_long_as_page_02_says() {
    let chapter = chapter("02_ray");
    let inspection = inspect(&chapter.world(&Asked::default()), &chapter.stages(), 32).expect("inspects");
    let (mut worst, mut rays) = (0.0_f64, 0);
    for &tile in &inspection.tiles {
        let world_rays = inspection.world.get::<WorldRays>(tile).expect("a column");
        for row in 0..world_rays.dx.len() {
            worst = worst.max((world_rays.direction_of(row).length() - 1.0).abs() * f64::from(1_u32 << 24));
            rays += 1;
        }
    }
    assert_eq!(rays, 129_600);
    page_says(
        "02_ray.md",
        &format!("the 129,600 rays of the picture, $\\lvert \\lVert R \\rVert - 1 \\rvert$ is at most {worst:.2} $u$"),
    );
}

/// The one sentence that a chapter's scene is refused with after its camera was changed.
fn refusal(name: &str, change: impl Fn(&mut EntityWorldMut<'_>)) -> String {
    let mut world = chapter(name).world(&Asked::default());
    let camera = pinhole::extract::camera_entity(&world).expect("a camera");
    change(&mut world.entity_mut(camera));
    validate(&world).expect_err("refused").to_string()
}

#[test]
fn refusals_are_worded_as_the_pages_say() {
    let resolution = Resolution { width: 0, height: 270 };
    let narrow = |fov| PerspectiveCamera { fov: Degrees(fov), axis: FovAxis::Vertical };
    let eye = DVec3::new(0.0, 2.6, 6.0);
    let look = |target| LookAt { eye, target, ..LookAt::default() };
    for (page, sentence) in [
        ("01_image.md", refusal("01_image", |camera| _ = camera.insert(resolution))),
        ("02_ray.md", refusal("02_ray", |camera| _ = camera.insert(narrow(0.06)))),
        (
            "04_orthographic.md",
            refusal("04_orthographic", |camera| _ = camera.insert(OrthographicCamera { view_height: 0.0 })),
        ),
        ("04_orthographic.md", refusal("04_orthographic", |camera| _ = camera.insert(look(eye)))),
        (
            "04_orthographic.md",
            refusal("04_orthographic", |camera| _ = camera.insert(look(DVec3::new(0.0, -1.0, 6.0)))),
        ),
        ("05_pinhole.md", refusal("05_pinhole", |camera| _ = camera.insert(narrow(0.01)))),
    ] {
        page_says(page, &sentence);
    }
}
