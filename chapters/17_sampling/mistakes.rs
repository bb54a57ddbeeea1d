//! Typical wrong solutions of chapter 17, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::tent_offset;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(tent_offset)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|u, r| (2.0 * u - 1.0) * r), "a box"),
        (exercise(from_the_rim), "highest in the middle"),
        (exercise(without_root), "square root is missing"),
        (exercise(|u, _| tent_offset(u, 1.0)), "radius is left out"),
        (exercise(|u, r| r * (1.0 - (1.0 - u).sqrt())), "on one side"),
        (exercise(|u, r| tent_offset(1.0 - u, r)), "swapped"),
    ]
}

/// Where the area up to the place is counted from the tent's end as if from its top.
fn from_the_rim(u: f64, radius: f64) -> f64 {
    if u < 0.5 { -radius * (1.0 - 2.0 * u).sqrt() } else { radius * (2.0 * u - 1.0).sqrt() }
}

fn without_root(u: f64, radius: f64) -> f64 {
    if u < 0.5 { radius * (4.0 * u * u - 1.0) } else { radius * (1.0 - 4.0 * (1.0 - u) * (1.0 - u)) }
}
