//! Typical wrong solutions of chapter 06, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::pixel_from_ndc;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(pixel_from_ndc)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|[x, y], w, h| Some([(x * w as f64) as u32, (y * h as f64) as u32])), "outside"),
        (exercise(clamped), "belongs to none"),
        (exercise(one_too_many), "does not have"),
        (exercise(closed), "1 counts as inside"),
        (exercise(less_one), "size less 1"),
        (exercise(rounded), "nearest"),
    ]
}

fn clamped([x, y]: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let along = |n: f64, size: u32| ((n * f64::from(size)).floor().max(0.0) as u32).min(size - 1);
    Some([along(x, width), along(y, height)])
}

fn one_too_many([x, y]: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let outside = x < 0.0 || y < 0.0 || x > 1.0 || y > 1.0 || x.is_nan() || y.is_nan();
    (!outside).then(|| [(x * f64::from(width)) as u32, (y * f64::from(height)) as u32])
}

fn closed([x, y]: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let along = |n: f64, size: u32| (0.0..=1.0).contains(&n).then(|| ((n * f64::from(size)) as u32).min(size - 1));
    Some([along(x, width)?, along(y, height)?])
}

fn less_one([x, y]: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let along = |n: f64, size: u32| (0.0..1.0).contains(&n).then(|| (n * f64::from(size - 1)) as u32);
    Some([along(x, width)?, along(y, height)?])
}

fn rounded([x, y]: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let along = |n: f64, size: u32| (0.0..1.0).contains(&n).then(|| (n * f64::from(size)).round() as u32);
    Some([along(x, width)?, along(y, height)?])
}
