//! Typical wrong solutions of chapter 01, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::raster_from_index;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(raster_from_index)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|i, w| [(i % w as u64) as f64, (i / w as u64) as f64]), "half is missing"),
        (exercise(|i, w| [(i as u32 % w) as f64 + 0.5, (i as u32 / w) as f64 + 0.5]), "32 bits"),
        (exercise(|i, w| [(i / w as u64) as f64 + 0.5, (i % w as u64) as f64 + 0.5]), "swapped"),
        (exercise(fractional_row), "counted whole"),
    ]
}

fn fractional_row(index: u64, width: u32) -> [f64; 2] {
    [(index % u64::from(width)) as f64 + 0.5, index as f64 / f64::from(width) + 0.5]
}
