//! The numbers and sentences that stand in a page as text are computed here, and must stand there as computed.

use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3, Vec3};
use pinhole::extract::validate;
use pinhole::film::{Curve, byte_from_linear, linear_from_srgb};
use pinhole::intersect::{NO_SHAPE, Surfaces};
use pinhole::plan::{Census, plan};
use pinhole::rays::WorldRays;
use pinhole::render::inspect;
use pinhole::scene::*;
use pinhole::shade::{ShadowHits, ShadowRays};
use pinhole::{Chapter, Overrides};
use pinhole_lab::naive::euler::{pitch_yaw_roll, yaw_pitch_roll};
use std::path::Path;

#[path = "book_numbers/material.rs"]
mod material;
#[path = "book_numbers/spaces.rs"]
mod spaces;
#[path = "book_numbers/transport.rs"]
mod transport;

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
    let inspection = inspect(&chapter.world(&Overrides::default()), &chapter.stages(), 32).expect("inspects");
    let (mut worst, mut rays) = (0.0_f64, 0);
    for &tile in &inspection.tiles {
        let world_rays = inspection.world.get::<WorldRays>(tile).expect("a column");
        for row in 0..world_rays.direction[0].len() {
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
fn scene_error(name: &str, change: impl Fn(&mut EntityWorldMut<'_>)) -> String {
    let mut world = chapter(name).world(&Overrides::default());
    let camera = pinhole::extract::camera_entity(&world).expect("a camera");
    change(&mut world.entity_mut(camera));
    validate(&Census::of(&world)).expect_err("refused").to_string()
}

#[test]
fn refusals_are_worded_as_the_pages_say() {
    let resolution = Resolution { width: 0, height: 270 };
    let with_tiny_angle = |fov| PerspectiveCamera { fov: Degrees(fov), axis: FovAxis::Vertical };
    let eye = DVec3::new(0.0, 2.6, 6.0);
    let look = |target| LookAt { eye, target, ..LookAt::default() };
    let down = LookAt { up: DVec3::NEG_Y, ..look(DVec3::new(0.0, -1.0, 6.0)) };
    let (stand, along) = (DVec3::new(3.0, 2.6, 4.5), DVec3::new(-30.0, -19.0, -45.0));
    for (page, sentence) in [
        ("01_image.md", scene_error("01_image", |camera| _ = camera.insert(resolution))),
        ("02_ray.md", scene_error("02_ray", |camera| _ = camera.insert(with_tiny_angle(0.06)))),
        (
            "04_orthographic.md",
            scene_error("04_orthographic", |camera| _ = camera.insert(OrthographicCamera { view_height: 0.0 })),
        ),
        ("04_orthographic.md", scene_error("04_orthographic", |camera| _ = camera.insert(look(eye)))),
        ("04_orthographic.md", scene_error("04_orthographic", |camera| _ = camera.insert(down))),
        ("05_pinhole.md", scene_error("05_pinhole", |camera| _ = camera.insert(with_tiny_angle(0.01)))),
        (
            "09_camera_to_world.md",
            scene_error("09_camera_to_world", |camera| camera.get_mut::<LookAt>().expect("looks").target = stand),
        ),
        (
            "09_camera_to_world.md",
            scene_error("09_camera_to_world", |camera| camera.get_mut::<LookAt>().expect("looks").up = along),
        ),
    ] {
        page_says(page, &sentence);
    }
}

#[test]
fn angles_are_as_page_09_says() {
    let [yaw, pitch, none] = [40.0, 30.0, 0.0].map(Degrees);
    let view = |axes: DMat3| {
        let [x, y, z] = (-axes.z_axis).to_array();
        format!("$({x:.3}, {y:.3}, {z:.3})$")
    };
    let [one, other] = [yaw_pitch_roll(yaw, pitch, none), pitch_yaw_roll(yaw, pitch, none)].map(view);
    let sentence = format!("With yaw 40° and pitch 30°, the one camera looks along {one}, the other along {other}.");
    page_says("09_camera_to_world.md", &sentence);
    let up = Degrees(90.0);
    let off = yaw_pitch_roll(Degrees(50.0), up, none) - yaw_pitch_roll(none, up, Degrees(-50.0));
    assert!(off.to_cols_array().iter().all(|part| part.abs() < 1e-15));
    page_says("09_camera_to_world.md", "yaw 50° gives the same axes as roll −50°, to within $10^{-15}$.");
}

#[test]
fn numbers_of_f32_are_as_far_apart_as_page_10_says() {
    for coordinate in [5.5e5_f32, 6e5, 7e5] {
        assert_eq!(coordinate.next_up() - coordinate, 1.0 / 16.0);
    }
    page_says("10_light_and_shadow.md", "around $6\\cdot 10^5$, where neighbouring f32 numbers are 1/16 apart");
}

/// Whether the warm lamp of chapter 10, standing here and alone, lights the slope, and whether it lights any ball.
fn lit_from(place: [f64; 3]) -> [bool; 2] {
    let chapter = chapter("10_light_and_shadow");
    let mut world = chapter.world(&Overrides::default());
    let mut lamps = world.query_filtered::<Entity, With<PointLight>>();
    let [warm, cool] = lamps.iter(&world).collect::<Vec<_>>()[..] else { panic!("two lamps") };
    world.despawn(cool);
    world.entity_mut(warm).insert(Placement { position: place.into(), ..Placement::default() });
    let inspection = inspect(&world, &chapter.stages(), 32).expect("inspects");
    let mut lit = [false; 2];
    for &tile in &inspection.tiles {
        let tile = inspection.world.entity(tile);
        let (rays, shadows) = (tile.get::<ShadowRays>().expect("rays"), tile.get::<ShadowHits>().expect("shadows"));
        let surfaces = tile.get::<Surfaces>().expect("surfaces");
        for (ray, &path) in rays.row.iter().enumerate().filter(|(ray, _)| shadows.shape[*ray] == NO_SHAPE) {
            assert!(rays.irradiance[0][ray] > 0.0);
            let slope = surfaces.get(path as usize).normal == slope_normal();
            lit[usize::from(!slope)] = true;
        }
    }
    lit
}

fn slope_normal() -> Vec3 {
    DVec3::new(0.0, 40.0, 9.0).normalize().as_vec3()
}

#[test]
fn lamps_in_odd_places_are_as_page_10_says() {
    assert_eq!(lit_from([-4.0, 4.6, 3.4]), [true, true], "where it stands");
    assert_eq!(lit_from([-0.3, 1.025, 0.0]), [false, false], "inside the large ball");
    assert_eq!(lit_from([-2.0, -1.0, 2.0]), [false, false], "beneath the slope");
    assert_eq!(lit_from([-2.0, -0.45, 2.0]), [false, true], "on the slope");
}

#[test]
fn lamps_without_shadows_drop_what_page_10_says() {
    let chapter = chapter("10_light_and_shadow");
    let mut world = chapter.world(&Overrides::default());
    let kept = |world: &World| {
        let plan = plan(&Census::of(world), &chapter.stages()).expect("a plan");
        plan.stages.iter().map(|stage| stage.name).collect::<Vec<_>>()
    };
    let all = kept(&world);
    let mut lamps = world.query::<&mut PointLight>();
    let mut changed = Vec::new();
    for lamp in 0..2 {
        if let Some(mut light) = lamps.iter_mut(&mut world).nth(lamp) {
            light.casts_shadows = false;
        }
        let now = kept(&world);
        changed.push(all.iter().copied().filter(|name| !now.contains(name)).collect::<Vec<_>>());
    }
    let three = vec!["Clear shadow hits", "Trace shadow rays: spheres", "Trace shadow rays: planes"];
    assert_eq!(changed, [vec![], three]);
}

/// Numbers of five digits and more that a worked example computes with stand in a trace of its page, where it has any.
#[test]
fn what_a_worked_example_computes_with_stands_in_its_trace() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("book/src");
    let all = chapters::all();
    let (mut pages, mut numbers) = (0, 0);
    for file in std::fs::read_dir(folder).expect("the book") {
        let path = file.expect("a page").path();
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        let Some(example) = text.split("## A worked example").nth(1).and_then(|rest| rest.split("\n## ").next()) else {
            continue;
        };
        let between = |text: &str, open: &str| {
            let parts = text.split(open).skip(1).filter_map(|rest| rest.split("}}").next());
            parts.map(String::from).collect::<Vec<_>>()
        };
        let mut traced = Vec::new();
        for words in between(&text, "{{#pinhole trace ") {
            let words: Vec<String> = ["trace"].into_iter().chain(words.split_whitespace()).map(String::from).collect();
            pinhole_cli::command::run(&all, &words, &mut traced).expect("a trace");
        }
        let traced = String::from_utf8(traced).expect("a text");
        if traced.is_empty() {
            continue;
        }
        let traced: Vec<f64> = numbers_in(&traced).filter_map(|number| number.parse().ok()).collect();
        pages += 1;
        for expression in between(example, "{{= ") {
            let digits = |number: &&str| number.trim_start_matches(['0', '.']).replace('.', "").len() >= 5;
            for number in numbers_in(&expression).filter(digits) {
                let decimals = number.split('.').nth(1).unwrap_or_default().len();
                let value: f64 = number.parse().expect("a number");
                let is_it = |traced: &f64| (traced.abs() - value).abs() < 0.5001 * 0.1_f64.powi(decimals as i32);
                let page = path.display();
                assert!(
                    traced.iter().any(is_it),
                    "{page} computes with {number}, which no trace of it has: {expression}"
                );
                numbers += 1;
            }
        }
    }
    eprintln!("numbers of {pages} pages that stand in their traces: {numbers}");
    assert!(pages >= 4 && numbers >= 12);
}

fn numbers_in(text: &str) -> impl Iterator<Item = &str> {
    let parts = text.split(|letter: char| !(letter.is_ascii_digit() || letter == '.'));
    parts.filter(|part| part.contains('.') && part.parse::<f64>().is_ok())
}
