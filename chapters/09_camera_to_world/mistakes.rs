//! Typical wrong solutions of chapter 09, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::normal_world_from_object;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(normal_world_from_object)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![(exercise(as_a_direction), "as a direction"), (exercise(cofactors), "sign of the determinant")]
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

fn as_a_direction([a, b, c]: [[f64; 3]; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    normalised([0, 1, 2].map(|i| a[i] * x + b[i] * y + c[i] * z))
}

fn cofactors([a, b, c]: [[f64; 3]; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    let cross =
        |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    as_a_direction([cross(b, c), cross(c, a), cross(a, b)], [x, y, z])
}
