//! Typical wrong solutions of chapter 28, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::ray_in_object_space;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(ray_in_object_space)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(normalised), "of length 1"),
        (exercise(|o, d, p, axes, s| [ray_in_object_space(o, d, p, axes, s)[0], moved(d, p, axes, s)]), "no place"),
        (exercise(|o, d, p, axes, _| ray_in_object_space(o, d, p, axes, [1.0; 3])), "scale is left out"),
        (exercise(|o, d, p, axes, s| ray_in_object_space(o, d, p, axes, s.map(|part| 1.0 / part))), "multiplied"),
        (exercise(|o, d, p, axes, s| ray_in_object_space(o, d, p, across(axes), s)), "object to world space"),
        (exercise(|o, d, _, axes, s| ray_in_object_space(o, d, [0.0; 3], axes, s)), "position"),
    ]
}

fn normalised(o: [f64; 3], d: [f64; 3], p: [f64; 3], axes: [[f64; 3]; 3], s: [f64; 3]) -> [[f64; 3]; 2] {
    let [origin, direction] = ray_in_object_space(o, d, p, axes, s);
    let length = direction.iter().map(|part| part * part).sum::<f64>().sqrt();
    [origin, direction.map(|part| part / length)]
}

/// The direction taken for a point.
fn moved(d: [f64; 3], p: [f64; 3], axes: [[f64; 3]; 3], s: [f64; 3]) -> [f64; 3] {
    ray_in_object_space(d, d, p, axes, s)[0]
}

/// Rows for columns.
fn across(axes: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| axes.map(|axis| axis[row]))
}
