//! Typical wrong solutions of chapter 30, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::to_visit;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(to_visit)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|enters, closest| [to_visit(enters, closest)[0], None]), "the farther child is left out"),
        (exercise(|enters, _| to_visit(enters, f64::INFINITY)), "behind the closest hit"),
        (exercise(in_the_order_of_the_list), "child 0 first"),
        (exercise(farther_first), "the farther child comes first"),
        (
            exercise(|enters, closest| [0, 1].map(|at| enters[at].filter(|&t| t < closest).map(|_| at as u32))),
            "None stands before a child",
        ),
    ]
}

fn in_the_order_of_the_list(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    match to_visit(enters, closest) {
        [Some(1), Some(0)] => [Some(0), Some(1)],
        order => order,
    }
}

fn farther_first(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    match to_visit(enters, closest) {
        [first, Some(second)] => [Some(second), first],
        order => order,
    }
}
