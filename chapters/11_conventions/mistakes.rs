//! Typical wrong solutions of chapter 11, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::pinhole_from_theirs;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(pinhole_from_theirs)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|v, _, _, _| v), "as it is"),
        (exercise(|[x, y, z], r, u, a| [s(r, x), s(u, y), s(a, z)]), "should not be"),
        (exercise(|[x, y, z], r, u, _| [s(r, x), s(u, y), z]), "z is never"),
        (exercise(|[x, y, z], _, u, a| [x, s(u, y), s(!a, z)]), "x is never"),
    ]
}

fn s(keep: bool, part: f64) -> f64 {
    if keep { part } else { -part }
}
