//! Answers that readers of chapter 30 gave who saw its page and nothing else, and words of the remark that each must get.

use super::question::exercise;
use pinhole_lab::exercise::Exercise;

/// The formula straight from the page.
pub fn textbook() -> Exercise {
    exercise(right)
}

/// What each reader thought, and the answer.
pub fn all() -> Vec<(&'static str, Exercise, &'static str)> {
    vec![
        (
            "slot i of the answer is for child i, so a child that is not visited leaves None in its own slot; only if both are visited do I sort",
            exercise(a),
            "None stands before a child",
        ),
        ("the ray ends in the nearer box, so only that one is visited", exercise(b), "farther child is left out"),
        (
            "what is pushed last comes off the stack first, so the farther child goes first into the array",
            exercise(c),
            "farther child comes first",
        ),
        (
            "a box that the ray enters is visited; the closest hit is compared later, when a primitive is tested",
            exercise(d),
            "behind the closest hit",
        ),
        (
            "a t of 0 or below is no entry: a box that the ray starts in is not visited",
            exercise(e),
            "in which the ray begins",
        ),
        (
            "if the nearer box begins before the closest hit, both are visited, for boxes overlap",
            exercise(f),
            "both are visited",
        ),
        (
            "I compared the nearer child with the closest hit; if that one is visited, the farther one follows in any case, since it must not be left out.",
            exercise(second_a),
            "both are visited if the nearer one",
        ),
        (
            "Each place of the answer belongs to one child: its number if it is visited and None if not.",
            exercise(second_b),
            "None stands before a child",
        ),
        (
            "A box for which there is no entry is one that the ray is in from the start, so I counted it as entered at 0.",
            exercise(second_c),
            "a child is visited whose box the",
        ),
    ]
}

fn right(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    let visited = |t: Option<f64>| t.filter(|&t| t < closest);
    match (visited(enters[0]), visited(enters[1])) {
        (Some(lower), Some(upper)) => {
            if upper < lower {
                [Some(1), Some(0)]
            } else {
                [Some(0), Some(1)]
            }
        }
        (Some(_), None) => [Some(0), None],
        (None, Some(_)) => [Some(1), None],
        (None, None) => [None, None],
    }
}

fn a(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    let mut order = [None, None];
    for i in 0..2 {
        if enters[i].is_some_and(|t| t < closest) {
            order[i] = Some(i as u32);
        }
    }
    if let (Some(lower), Some(upper)) = (enters[0], enters[1])
        && upper < lower
    {
        order.swap(0, 1);
    }
    order
}

fn b(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
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

fn c(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    let lower = enters[0].filter(|&t| t < closest);
    let upper = enters[1].filter(|&t| t < closest);
    match (lower, upper) {
        (Some(l), Some(u)) if u < l => [Some(0), Some(1)],
        (Some(_), Some(_)) => [Some(1), Some(0)],
        (Some(_), None) => [Some(0), None],
        (None, Some(_)) => [Some(1), None],
        (None, None) => [None, None],
    }
}

fn d(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    let _ = closest;
    match (enters[0], enters[1]) {
        (Some(l), Some(u)) if u < l => [Some(1), Some(0)],
        (Some(_), Some(_)) => [Some(0), Some(1)],
        (Some(_), None) => [Some(0), None],
        (None, Some(_)) => [Some(1), None],
        (None, None) => [None, None],
    }
}

fn e(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
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

fn f(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    match (enters[0], enters[1]) {
        (Some(l), Some(u)) => {
            if l.min(u) >= closest {
                [None, None]
            } else if u < l {
                [Some(1), Some(0)]
            } else {
                [Some(0), Some(1)]
            }
        }
        (Some(l), None) if l < closest => [Some(0), None],
        (None, Some(u)) if u < closest => [Some(1), None],
        _ => [None, None],
    }
}

fn second_a(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
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

fn second_b(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    let mut result: [Option<u32>; 2] = [None, None];
    for i in 0..2 {
        if enters[i].is_some_and(|t| t <= closest) {
            result[i] = Some(i as u32);
        }
    }
    result
}

fn second_c(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
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
