//! Directions chosen by an image of all directions, against sums over it.

use super::*;
use bevy_ecs::prelude::*;
use glam::DVec2;
use pinhole::extract::{EnvironmentLightTable, EnvironmentTable, Texels};
use pinhole::plan::{Census, Table};
use pinhole::scene::{Degrees, Environment, PerspectiveCamera};
use pinhole::shade::{direction_of, environment_direction, environment_pdf, environment_radiance};
use std::f64::consts::{PI, TAU};

/// The evening of chapter 16, turned.
pub fn evening(turn: f64) -> EnvironmentTable {
    let mut world = World::new();
    world.spawn(PerspectiveCamera::default());
    let file = String::from("chapters/16_textures/evening.hdr");
    world.spawn(Environment { file, turn: Degrees(turn), scale: 1.0 });
    EnvironmentTable::extract(&Census::of(&world)).expect("the image of chapter 16")
}

/// One texel that shines in a black image.
fn lamp(width: usize, height: usize, at: [usize; 2]) -> EnvironmentTable {
    let mut rgb = vec![[0.0; 3]; width * height];
    rgb[at[1] * width + at[0]] = [100.0, 50.0, 10.0];
    EnvironmentTable { image: Texels { width, height, rgb }.into(), turn: [0.6, 0.8], remarks: Vec::new() }
}

/// The sum of a function over all directions, texel by texel in `fine`² parts.
pub fn summed(environment: &EnvironmentTable, fine: usize, of: impl Fn(DVec3) -> f64) -> f64 {
    let (width, height) = (environment.image.width * fine, environment.image.height * fine);
    let mut sum = 0.0;
    for line in 0..height {
        let cosine = |edge: usize| libm::cos(edge as f64 / height as f64 * PI);
        let angle = TAU / width as f64 * (cosine(line) - cosine(line + 1));
        let mut along = 0.0;
        for column in 0..width {
            let at = DVec2::new((column as f64 + 0.5) / width as f64, (line as f64 + 0.5) / height as f64);
            along += of(turned(environment, direction_of(at)));
        }
        sum += along * angle;
    }
    sum
}

/// The direction in the world of one in the image.
fn turned(environment: &EnvironmentTable, there: DVec3) -> DVec3 {
    let [sine, cosine] = environment.turn;
    DVec3::new(there.x * cosine + there.z * sine, there.y, there.z * cosine - there.x * sine)
}

#[test]
fn directions_fall_as_their_pdfs_say() {
    let mut images = vec![("evening", evening(0.0)), ("evening, turned", evening(77.0))];
    for (width, height, at) in [(16, 8, [3, 4]), (16, 8, [0, 0]), (16, 8, [15, 7]), (7, 3, [6, 0]), (5, 1, [2, 0])] {
        images.push(("a lamp", lamp(width, height, at)));
    }
    images.push(("one texel", lamp(1, 1, [0, 0])));
    let mut tried = 0;
    for (index, (name, environment)) in images.iter().enumerate() {
        let light = EnvironmentLightTable::new(&environment.image);
        let fine = if name.starts_with("evening") { 4 } else { 40 };
        // Cells end in the middles of texels, so an even number of parts a texel does not cross them.
        let whole = summed(environment, fine, |direction| environment_pdf(&light, environment.turn, direction));
        assert!((whole - 1.0).abs() < 1e-9, "{name}: pdfs sum to {whole}");
        let mut worst = 0.0_f64;
        let normals = [DVec3::Y, DVec3::X, DVec3::new(-0.3, -0.8, 0.5).normalize()];
        let mut received = [[0.0; 2]; 3];
        const RAYS: u32 = 300_000;
        for number in 0..RAYS {
            let mut draws = Draws::new(300 + index as u64, u64::from(number));
            let (direction, pdf) = environment_direction(&light, environment.turn, [draws.unit(), draws.unit()]);
            assert!((direction.length() - 1.0).abs() < 1e-12 && pdf > 0.0, "{name}: {direction} {pdf}");
            let again = environment_pdf(&light, environment.turn, direction);
            worst = worst.max((again / pdf - 1.0).abs());
            let red = environment_radiance(environment, direction)[0];
            for (normal, [sum, squares]) in normals.iter().zip(&mut received) {
                let told = red * normal.dot(direction).max(0.0) / pdf;
                *sum += told;
                *squares += told * told;
            }
            tried += 1;
        }
        assert!(worst < 1e-12, "{name}: a pdf differs from itself by {worst}");
        for (normal, [sum, squares]) in normals.iter().zip(received) {
            let mean = sum / f64::from(RAYS);
            let error = ((squares / f64::from(RAYS) - mean * mean) / f64::from(RAYS)).sqrt();
            let truth = summed(environment, fine, |direction| {
                environment_radiance(environment, direction)[0] * normal.dot(direction).max(0.0)
            });
            if truth == 0.0 {
                assert_eq!(mean, 0.0, "{name} on {normal}, which faces away");
                continue;
            }
            let off = (mean - truth) / error;
            eprintln!("{name:15} {normal:.1?}: {mean:.6} for {truth:.6}, {off:+.2} standard errors of {error:.6}");
            assert!(off.abs() < 4.0, "{name} on {normal}: {mean} for {truth}, {off} standard errors");
            assert!(error <= 0.01 * truth, "{name}: the error is {error} of {truth}");
        }
    }
    eprintln!("environments: {} images, {tried} directions", images.len());
}

/// What is black all round is never chosen, and what is not black may be.
#[test]
fn only_black_cells_have_no_pdf() {
    let mut compared = 0;
    for (width, height) in [(8, 4), (7, 5), (1, 2), (3, 1)] {
        for at in 0..width * height {
            let environment = lamp(width, height, [at % width, at / width]);
            let light = EnvironmentLightTable::new(&environment.image);
            for number in 0..2000 {
                let direction = Draws::new(400, number).unit_vector();
                let shines = environment_radiance(&environment, direction)[0] > 0.0;
                let pdf = environment_pdf(&light, environment.turn, direction);
                assert!(pdf > 0.0 || !shines, "{width} × {height}, lamp {at}: light from {direction} is missed");
                compared += 1;
            }
        }
    }
    let black = EnvironmentLightTable::new(&Texels::single([0.0; 3]));
    assert_eq!(environment_direction(&black, [0.0, 1.0], [0.999, 0.999]).1, 0.0, "no light, no direction");
    eprintln!("environments: {compared} directions, light nowhere without a pdf");
}
