//! Typical wrong solutions of chapter 19, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::mirrored;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(mirrored)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|d, n| off_mirror(d, n, -2.0)), "unit vector"),
        (exercise(|d, n| off_mirror(d, n, -2.0 / dot(n, n)).map(|part| -part)), "goes into"),
        (exercise(|d, n| off_mirror(d, n, -1.0 / dot(n, n))), "2 is missing"),
        (exercise(|d, _| d.map(|part| -part)), "back where it came from"),
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn off_mirror(d: [f64; 3], n: [f64; 3], times: f64) -> [f64; 3] {
    let along = times * dot(d, n);
    [0, 1, 2].map(|part| d[part] + along * n[part])
}
