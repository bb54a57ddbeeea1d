//! Typical wrong solutions of chapter 24, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::{moving_sphere_t, nearest_sphere_t};
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(moving_sphere_t)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|o, d, c, r, _, _| nearest_sphere_t(o, d, c, r)), "stands still"),
        (exercise(|o, d, c, r, v, s| moving_sphere_t(o, d, c, r, v, -s)), "backwards"),
        (exercise(|o, d, c, r, v, _| moving_sphere_t(o, d, c, r, v, 1.0)), "time is left out"),
    ]
}
