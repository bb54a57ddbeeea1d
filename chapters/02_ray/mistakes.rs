//! Typical wrong solutions of chapter 02, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::unit;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(unit)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|v| Some(divided(v, length(v)))), "squares overflow"),
        (exercise(|v| (length(v) > 0.0).then(|| divided(v, length(v)))), "squares overflow"),
        (exercise(finite_or_none), "squares overflow"),
        (exercise(|v| Some(divided(v, length(v) * length(v)))), "square root is missing"),
        (exercise(scaled_but_never_none), "None"),
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

fn finite_or_none(v: [f64; 3]) -> Option<[f64; 3]> {
    let unit = normalised(v);
    unit.iter().all(|part| part.is_finite()).then_some(unit)
}

fn scaled_but_never_none(v: [f64; 3]) -> Option<[f64; 3]> {
    let largest = v[0].abs().max(v[1].abs()).max(v[2].abs());
    Some(normalised(divided(v, largest)))
}
