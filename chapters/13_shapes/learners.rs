//! Answers that readers of chapter 13 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "a slab is entered at its smaller coordinate and left at its larger one",
            exercise(a),
            "entered at its smaller coordinate",
        ),
        (
            "the hit is where the ray enters; if it has entered behind its start, the box is behind and not hit",
            exercise(b),
            "from inside, nothing is hit",
        ),
        (
            "the ray is in the box from the first slab that it enters to the last that it leaves",
            exercise(c),
            "while any slab has it",
        ),
        (
            "a ray along a slab is not limited by it, so an axis whose direction is 0 is skipped",
            exercise(d),
            "is left out; the ray may run beside",
        ),
        (
            "try all six faces as planes, keep the nearest whose point lies between the other four",
            exercise(e),
            "through an edge",
        ),
        (
            "only what is ahead counts, so the ray's part inside the box begins at 0 and the slabs make it shorter",
            exercise(f),
            "origin counts as the hit",
        ),
        (
            "I tried the six faces one after the other and returned the first whose point lies within it.",
            exercise(second_a),
            "the first or last face that is found counts",
        ),
        (
            "I used the page's (n·f ∓ h) / n·R with the centre between the corners, and took for h how large the box is, most − least.",
            exercise(second_b),
            "a whole size from the centre",
        ),
        (
            "Only what is ahead counts, so I began the entry at 0, and the entry is the answer; who is inside already is at the box at once.",
            exercise(second_c),
            "from inside, the origin counts as",
        ),
    ]
}

fn right(origin: [f64; 3], direction: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<f64> {
    let mut enter = f64::NEG_INFINITY;
    let mut leave = f64::INFINITY;
    for i in 0..3 {
        let t0 = (least[i] - origin[i]) / direction[i];
        let t1 = (most[i] - origin[i]) / direction[i];
        enter = enter.max(t0.min(t1));
        leave = leave.min(t0.max(t1));
    }
    if enter > leave {
        None
    } else if enter > 0.0 {
        Some(enter)
    } else if leave > 0.0 {
        Some(leave)
    } else {
        None
    }
}

fn a(origin: [f64; 3], direction: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<f64> {
    let mut enter = f64::NEG_INFINITY;
    let mut leave = f64::INFINITY;
    for i in 0..3 {
        enter = enter.max((least[i] - origin[i]) / direction[i]);
        leave = leave.min((most[i] - origin[i]) / direction[i]);
    }
    if enter > leave {
        return None;
    }
    if enter > 0.0 {
        Some(enter)
    } else if leave > 0.0 {
        Some(leave)
    } else {
        None
    }
}

fn b(origin: [f64; 3], direction: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<f64> {
    let mut enter = f64::NEG_INFINITY;
    let mut leave = f64::INFINITY;
    for i in 0..3 {
        let t0 = (least[i] - origin[i]) / direction[i];
        let t1 = (most[i] - origin[i]) / direction[i];
        enter = enter.max(t0.min(t1));
        leave = leave.min(t0.max(t1));
    }
    if enter <= leave && enter > 0.0 { Some(enter) } else { None }
}

fn c(origin: [f64; 3], direction: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<f64> {
    let mut enter = f64::INFINITY;
    let mut leave = f64::NEG_INFINITY;
    for i in 0..3 {
        let t0 = (least[i] - origin[i]) / direction[i];
        let t1 = (most[i] - origin[i]) / direction[i];
        enter = enter.min(t0.min(t1));
        leave = leave.max(t0.max(t1));
    }
    if enter > leave {
        return None;
    }
    if enter > 0.0 {
        Some(enter)
    } else if leave > 0.0 {
        Some(leave)
    } else {
        None
    }
}

fn d(origin: [f64; 3], direction: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<f64> {
    let mut enter = f64::NEG_INFINITY;
    let mut leave = f64::INFINITY;
    for i in 0..3 {
        if direction[i] == 0.0 {
            continue;
        }
        let t0 = (least[i] - origin[i]) / direction[i];
        let t1 = (most[i] - origin[i]) / direction[i];
        enter = enter.max(t0.min(t1));
        leave = leave.min(t0.max(t1));
    }
    if enter > leave {
        None
    } else if enter > 0.0 {
        Some(enter)
    } else if leave > 0.0 {
        Some(leave)
    } else {
        None
    }
}

fn e(origin: [f64; 3], direction: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<f64> {
    let mut best: Option<f64> = None;
    for i in 0..3 {
        for face in [least[i], most[i]] {
            let t = (face - origin[i]) / direction[i];
            if !(t > 0.0 && t.is_finite()) {
                continue;
            }
            let j = (i + 1) % 3;
            let k = (i + 2) % 3;
            let pj = origin[j] + t * direction[j];
            let pk = origin[k] + t * direction[k];
            if pj > least[j] && pj < most[j] && pk > least[k] && pk < most[k] {
                best = match best {
                    Some(nearest) if nearest <= t => Some(nearest),
                    _ => Some(t),
                };
            }
        }
    }
    best
}

fn f(origin: [f64; 3], direction: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<f64> {
    let mut enter = 0.0f64;
    let mut leave = f64::INFINITY;
    for i in 0..3 {
        let inverse = 1.0 / direction[i];
        let t0 = (least[i] - origin[i]) * inverse;
        let t1 = (most[i] - origin[i]) * inverse;
        enter = enter.max(t0.min(t1));
        leave = leave.min(t0.max(t1));
    }
    if enter <= leave { Some(enter) } else { None }
}

fn second_a(origin: [f64; 3], direction: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<f64> {
    for k in 0..3 {
        if direction[k] == 0.0 {
            continue;
        }
        for face in [least[k], most[k]] {
            let t = (face - origin[k]) / direction[k];
            if !(t > 0.0) {
                continue;
            }
            let mut inside = true;
            for other in 0..3 {
                if other != k {
                    let p = origin[other] + t * direction[other];
                    if p < least[other] || p > most[other] {
                        inside = false;
                    }
                }
            }
            if inside {
                return Some(t);
            }
        }
    }
    None
}

fn second_b(origin: [f64; 3], direction: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<f64> {
    let mut enters = f64::NEG_INFINITY;
    let mut leaves = f64::INFINITY;
    for k in 0..3 {
        let centre = (least[k] + most[k]) / 2.0;
        let h = most[k] - least[k];
        let f = centre - origin[k];
        if direction[k] == 0.0 {
            if f.abs() > h {
                return None;
            }
            continue;
        }
        let one = (f - h) / direction[k];
        let two = (f + h) / direction[k];
        enters = enters.max(one.min(two));
        leaves = leaves.min(one.max(two));
    }
    if enters > leaves {
        None
    } else if enters > 0.0 {
        Some(enters)
    } else if leaves > 0.0 {
        Some(leaves)
    } else {
        None
    }
}

fn second_c(origin: [f64; 3], direction: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<f64> {
    let mut enters = 0.0_f64;
    let mut leaves = f64::INFINITY;
    for k in 0..3 {
        if direction[k] == 0.0 {
            if origin[k] < least[k] || origin[k] > most[k] {
                return None;
            }
            continue;
        }
        let one = (least[k] - origin[k]) / direction[k];
        let two = (most[k] - origin[k]) / direction[k];
        enters = enters.max(one.min(two));
        leaves = leaves.min(one.max(two));
    }
    if enters <= leaves { Some(enters) } else { None }
}
