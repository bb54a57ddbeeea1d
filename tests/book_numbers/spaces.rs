//! The numbers of pages 06 to 08: NDC, the screen, the field of view.

use super::{chapter, page_says, scene_error};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::extract::{SMALLEST_PIXEL, tan_half, validate};
use pinhole::intersect::{Hits, NO_SHAPE};
use pinhole::plan::{Census, Column, Stage, TileSystems, VectorRows, VectorRowsMut};
use pinhole::rays::{NdcPoints, RasterPoints};
use pinhole::render::inspect;
use pinhole::scene::*;
use pinhole::shade::Radiance;
use pinhole::{Overrides, extract};
use pinhole_lab::naive::projection::raster_from_world;
use pinhole_lab::naive::{field_of_view, ndc};

#[test]
fn the_naive_formulas_to_ndc_are_as_far_off_as_page_06_says() {
    let drift = |width: u32| {
        let last = ndc::by_steps(width).last().expect("a pixel");
        f64::from(last) * f64::from(width) - f64::from(width - 1)
    };
    let (left, none) = (drift(65_535), drift(65_536));
    page_says("06_ndc.md", &format!("The last of 65,535 pixels lies {:.3} pixels too far to the left.", -left));
    assert_eq!(none, 0.0);
    let ulp = f32::from_bits(65_535.0_f32.to_bits() + 1) - 65_535.0;
    page_says("06_ndc.md", &format!("{} places in the pixel", 1.0 / ulp + 1.0));
    assert_eq!(ndc::raster_of_sample(65_535, 1.0 - ulp / 2.0), 65_536.0);
    assert!(ndc::raster_of_sample(65_535, 1.0 - ulp * 0.51) < 65_536.0);
    assert_eq!(ulp / 2.0, 1.0 / 512.0);
    page_says("06_ndc.md", "One sample in 512 is rounded there.");
    page_says("06_ndc.md", &scene_error("06_ndc", |camera| _ = camera.insert(Resolution { width: 0, height: 240 })));
}

#[test]
fn a_reciprocal_misses_the_right_edge_of_some_images_as_page_06_says() {
    let missed: Vec<u32> = (1..=65_536).filter(|&width| f64::from(width) * (1.0 / f64::from(width)) != 1.0).collect();
    eprintln!("{} of 65536 widths, the first is {:?}", missed.len(), missed.first());
    assert!(!missed.is_empty());
    page_says("06_ndc.md", &format!("the right edge of {} of the 65,536 widths would miss 1", thousands(missed.len())));
}

fn thousands(number: usize) -> String {
    if number < 1000 { number.to_string() } else { format!("{},{:03}", thousands(number / 1000), number % 1000) }
}

/// NDC divided by W − 1, for an image of one pixel.
fn fill_with_nan(mut tiles: Query<(&RasterPoints, &mut NdcPoints)>) {
    for (raster, mut ndc) in &mut tiles {
        ndc.slices_mut(raster.rows()).put(0, [f64::from(ndc::to_last_pixel(0, 1)); 2]);
    }
}

#[test]
fn a_pixel_that_is_nowhere_shows_the_background_as_page_06_says() {
    let chapter = chapter("05_pinhole");
    let one = Overrides { resolution: Some(Resolution { width: 1, height: 1 }), ..Overrides::default() };
    let naive = Stage::new("Divide by the last pixel", TileSystems::Ndc, fill_with_nan);
    let mut stages = chapter.stages();
    let seen = |stages: &[Stage]| {
        let inspection = inspect(&chapter.world(&one), stages, 1).expect("inspects");
        let tile = inspection.world.entity(inspection.tiles[0]);
        let (hits, light) = (tile.get::<Hits>().expect("hits"), tile.get::<Radiance>().expect("light"));
        (hits.shape[0], light.rgb.at(0))
    };
    assert_ne!(seen(&stages).0, NO_SHAPE, "the one pixel sees a shape");
    stages.retain(|stage| stage.set != TileSystems::Ndc);
    stages.push(naive);
    assert_eq!(seen(&stages), (NO_SHAPE, [0.008, 0.012, 0.02]));
    page_says("06_ndc.md", "the pixel shows the background");
}

#[test]
fn angles_are_taken_and_refused_as_page_08_says() {
    let page = "08_field_of_view.md";
    let angle = |fov| PerspectiveCamera { fov: Degrees(fov), axis: FovAxis::Vertical };
    page_says(page, &scene_error("08_field_of_view", |camera| _ = camera.insert(angle(1e-4))));
    let lines = (2.0 * tan_half(Degrees(0.01)) / SMALLEST_PIXEL) as u32;
    page_says(page, &format!("0.01° is taken for an image of up to {lines} lines"));
    for (height, taken) in [(lines, true), (lines + 1, false)] {
        let mut world = chapter("08_field_of_view").world(&Overrides::default());
        let camera = extract::camera_entity(&world).expect("a camera");
        world.entity_mut(camera).insert((angle(0.01), Resolution { width: 64, height }));
        assert_eq!(validate(&Census::of(&world)).is_ok(), taken, "{height} lines");
    }
}

#[test]
fn the_naive_tangent_is_as_far_off_as_page_08_says() {
    let page = "08_field_of_view.md";
    let (naive, pinhole) = (f64::from(field_of_view::tan_half_f32(179.99)), tan_half(Degrees(179.99)));
    let steps = ((naive - pinhole) / pinhole).abs() * f64::from(1_u32 << 24);
    // That pinhole's own is good to less than a millionth of a step is checked in `src/lab/naive/field_of_view.rs`.
    let steps = thousands(steps.round() as usize);
    page_says(page, &format!("the tangent is off by {steps} u"));
    let flipped = field_of_view::tan_half_f32(180.0) / 1e7;
    page_says(page, &format!("the tangent is ${flipped:.1}\\cdot 10^7$"));
}

#[test]
fn the_table_of_angles_says_what_each_axis_sees_and_refuses_a_camera_without_an_angle() {
    let chapters = chapters::all();
    let run = |words: &str| {
        let (words, mut out) = (words.split(' ').map(String::from).collect::<Vec<_>>(), Vec::new());
        let done = pinhole_cli::command::run(&chapters, &words, &mut out).map_err(|error| error.to_string());
        done.map(|()| String::from_utf8(out).expect("text"))
    };
    let square = run("angles 08_field_of_view --size 300x300").expect("angles");
    let rows: Vec<Vec<&str>> = square.lines().skip(3).map(|line| line.split_whitespace().collect()).collect();
    for (row, name) in rows.iter().zip(["vertical", "horizontal", "smaller", "larger"]) {
        assert_eq!(*row, [name, "1.000000", "0.577350", "60.0000°"]);
    }
    // √2 · tan 30°, and twice its arc tangent.
    assert_eq!(rows[4], ["diagonal", "1.414214", "0.816497", "78.4630°"]);
    let refused = run("angles 04_orthographic").expect_err("refused");
    assert_eq!(refused, "the camera of 04_orthographic is orthographic and has no angle");
}

#[test]
fn frames_points_and_neighbours_are_as_many_as_page_35_says() {
    let page = "35_real_time.md";
    let pixels = 1920 * 1080 * 60;
    page_says(page, &format!("has {} pixels a second", thousands(pixels)));
    page_says(page, &format!("that makes {:.0} million rays", 3.0 * pixels as f64 / 1e6));
    page_says(page, &format!("25 frames a second are {} rays", thousands(3 * 640 * 360 * 25)));
    let seen_from = |x: f64| {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        raster_from_world(DVec3::new(1.0, 2.0, 0.0), DVec3::new(x, 1.0, 4.0), axes, 0.5, DVec2::new(200.0, 100.0))
    };
    let [before, now] = [0.0, 0.5].map(seen_from);
    page_says(
        page,
        &format!("is now seen at $({}, {})$. The earlier frame had it at $({}, {})$", now.x, now.y, before.x, before.y),
    );
    page_says(page, &format!("$(0.8 + 15\\cdot0.5)/16 \\approx {:.2}$", (0.8 + 15.0 * 0.5) / 16.0));
    // Two neighbours on either side, 1, 2 and 4 pixels apart.
    let wide = 1 + 2 * 2 * (1 + 2 + 4);
    page_says(page, &format!("{wide} × {wide} pixels with {} weights instead of {}", 3 * 5 * 5, wide * wide));
}
