//! Typical wrong solutions of chapter 05, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::perspective_direction;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(perspective_direction)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|[x, y], t| [x * t, y * t, -1.0]), "not of length 1"),
        (exercise(|[x, y], _| normalised([x, y, -1.0])), "left out"),
        (exercise(|[x, y], t| normalised([x, y * t, -1.0])), "only y"),
        (exercise(|[x, y], t| normalised([-x * t, -y * t, -1.0])), "box with a hole"),
        (exercise(|[x, y], t| normalised([x * t.tan(), y * t.tan(), -1.0])), "taken of the tangent"),
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

fn divided(v: [f64; 3], by: f64) -> [f64; 3] {
    v.map(|part| part / by)
}

fn normalised(v: [f64; 3]) -> [f64; 3] {
    divided(v, length(v))
}
