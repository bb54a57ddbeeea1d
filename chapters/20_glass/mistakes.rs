//! Typical wrong solutions of chapter 20, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::refracted;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(refracted)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|d, n, eta| Some(through(d, n, eta))), "before you take it"),
        (exercise(|d, n, eta| passes(d, n, 1.0 / eta).then(|| through(d, n, 1.0 / eta))), "inverted"),
        (exercise(|d, _, _| Some(d)), "straight on"),
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn g_squared(d: [f64; 3], n: [f64; 3], eta: f64) -> f64 {
    eta * eta - 1.0 + dot(d, n) * dot(d, n)
}

fn passes(d: [f64; 3], n: [f64; 3], eta: f64) -> bool {
    g_squared(d, n, eta) >= 0.0
}

fn through(d: [f64; 3], n: [f64; 3], eta: f64) -> [f64; 3] {
    let along = -dot(d, n) - g_squared(d, n, eta).sqrt();
    [0, 1, 2].map(|part| (d[part] + along * n[part]) / eta)
}
