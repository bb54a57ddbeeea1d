//! Typical wrong solutions of chapter 04, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::orthographic_ray;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(orthographic_ray)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|[x, y], h| ([x * h, y * h, 0.0], AHEAD)), "twice as far"),
        (exercise(|[x, y], h| ([x * h / 2.0, y * h / 2.0, 0.0], [0.0, 0.0, 1.0])), "−z"),
        (exercise(|[x, y], h| ([x * h / 2.0, -y * h / 2.0, 0.0], AHEAD)), "y points down"),
    ]
}

const AHEAD: [f64; 3] = [0.0, 0.0, -1.0];
