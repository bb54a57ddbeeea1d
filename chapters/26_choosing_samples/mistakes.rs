//! Typical wrong solutions of chapter 26, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::power_heuristic;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(power_heuristic)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|p, q| if p == 0.0 { 0.0 } else { p / (p + q) }), "balance"),
        (exercise(|p, q| power_heuristic(q, p)), "swapped"),
        (exercise(|p, q| if p == 0.0 { 0.0 } else { p * p / (p * p + q * q) }), "overflow"),
        (exercise(|p, q| p * p / (p * p + q * q)), "overflow"),
        (exercise(|p, q| 1.0 / (1.0 + (q / p) * (q / p))), "divided by 0"),
        (exercise(|_, _| 0.5), "counts half"),
    ]
}
