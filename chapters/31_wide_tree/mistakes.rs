//! Typical wrong solutions of chapter 31, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::entered;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(entered)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|enters, leaves, closest| entered(enters, leaves, closest).reverse_bits() >> 24), "bit 0"),
        (exercise(|enters, leaves, _| entered(enters, leaves, f64::INFINITY)), "behind the closest hit"),
        (
            exercise(|enters, leaves, closest| those(|i| enters[i] <= leaves[i] && enters[i] <= closest)),
            "behind the ray",
        ),
        (
            exercise(|enters, leaves, closest| {
                those(|i| enters[i] <= leaves[i] && enters[i] >= 0.0 && enters[i] <= closest)
            }),
            "in which the ray starts",
        ),
        (exercise(|enters, leaves, closest| those(|i| leaves[i] >= 0.0 && enters[i] <= closest)), "misses"),
    ]
}

fn those(are: impl Fn(usize) -> bool) -> u32 {
    (0..8).map(|child| u32::from(are(child)) << child).sum()
}
