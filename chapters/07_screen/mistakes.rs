//! Typical wrong solutions of chapter 07, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::ndc_from_screen;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(ndc_from_screen)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|[x, y], _, _| [(x + 1.0) / 2.0, (1.0 - y) / 2.0]), "aspect is left out"),
        (exercise(|[x, y], w, h| [(x * aspect(w, h) + 1.0) / 2.0, (1.0 - y) / 2.0]), "divide"),
        (exercise(|[x, y], w, h| [(x / aspect(w, h) + 1.0) / 2.0, (y + 1.0) / 2.0]), "turned over"),
        (exercise(|[x, y], w, h| [(x + 1.0) / 2.0 / aspect(w, h), (1.0 - y) / 2.0]), "last step"),
    ]
}

fn aspect(width: u32, height: u32) -> f64 {
    f64::from(width) / f64::from(height)
}
