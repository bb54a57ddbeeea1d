//! Answers to the exercise of chapter 30: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "farther child is left out"),
            (exercise(second), "behind the closest hit"),
            (exercise(third), "in which the ray begins"),
            (exercise(fourth), "both are visited if the nearer one"),
            (exercise(fifth), "None stands before a child"),
            (exercise(sixth), "a child is visited whose box the"),
        ],
    }
}

pub fn solution(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    let [lower, upper] = enters.map(|t| t.filter(|&t| t < closest).unwrap_or(f64::INFINITY));
    let child = |number: u32, t: f64| (t < f64::INFINITY).then_some(number);
    let order = if upper < lower { [child(1, upper), child(0, lower)] } else { [child(0, lower), child(1, upper)] };
    // Where only child 1 is visited it is the first.
    if order[0].is_none() { [order[1], None] } else { order }
}

/// The ray ends in the nearer box, so only that one is visited.
fn first(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    let lower = enters[0].unwrap_or(f64::INFINITY);
    let upper = enters[1].unwrap_or(f64::INFINITY);
    if lower.min(upper) >= closest {
        [None, None]
    } else if upper < lower {
        [Some(1), None]
    } else {
        [Some(0), None]
    }
}

/// A box that the ray enters is visited; the closest hit is compared later, when a primitive is tested.
fn second(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    let _ = closest;
    match (enters[0], enters[1]) {
        (Some(l), Some(u)) if u < l => [Some(1), Some(0)],
        (Some(_), Some(_)) => [Some(0), Some(1)],
        (Some(_), None) => [Some(0), None],
        (None, Some(_)) => [Some(1), None],
        (None, None) => [None, None],
    }
}

/// A t of 0 or below is no entry: a box that the ray starts in is not visited.
fn third(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    let lower = enters[0].filter(|&t| t > 0.0 && t < closest);
    let upper = enters[1].filter(|&t| t > 0.0 && t < closest);
    match (lower, upper) {
        (Some(l), Some(u)) if u < l => [Some(1), Some(0)],
        (Some(_), Some(_)) => [Some(0), Some(1)],
        (Some(_), None) => [Some(0), None],
        (None, Some(_)) => [Some(1), None],
        (None, None) => [None, None],
    }
}

/// I compared the nearer child with the closest hit; if that one is visited, the farther one follows in any case,
/// since it must not be left out.
fn fourth(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    match (enters[0], enters[1]) {
        (Some(first), Some(second)) => {
            if first.min(second) > closest {
                [None, None]
            } else if second < first {
                [Some(1), Some(0)]
            } else {
                [Some(0), Some(1)]
            }
        }
        (Some(first), None) => {
            if first <= closest {
                [Some(0), None]
            } else {
                [None, None]
            }
        }
        (None, Some(second)) => {
            if second <= closest {
                [Some(1), None]
            } else {
                [None, None]
            }
        }
        (None, None) => [None, None],
    }
}

/// Each place of the answer belongs to one child: its number if it is visited and None if not.
fn fifth(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    let mut result: [Option<u32>; 2] = [None, None];
    for i in 0..2 {
        if enters[i].is_some_and(|t| t <= closest) {
            result[i] = Some(i as u32);
        }
    }
    result
}

/// A box for which there is no entry is one that the ray is in from the start, so I counted it as entered at 0.
fn sixth(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    let first = enters[0].unwrap_or(0.0);
    let second = enters[1].unwrap_or(0.0);
    let order: [(f64, u32); 2] = if second < first { [(second, 1), (first, 0)] } else { [(first, 0), (second, 1)] };
    let mut result: [Option<u32>; 2] = [None, None];
    let mut count = 0;
    for &(t, child) in order.iter() {
        if t <= closest {
            result[count] = Some(child);
            count += 1;
        }
    }
    result
}
