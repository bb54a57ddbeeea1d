//! Answers to the exercise of chapter 13: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: Some(exercise(textbook)),
        wrong: [
            (exercise(first), "entered at its smaller coordinate"),
            (exercise(second), "from inside, nothing is hit"),
            (exercise(third), "while any slab has it"),
            (exercise(fourth), "through an edge"),
            (exercise(fifth), "Second, the far side is taken"),
            (exercise(sixth), "a whole size from the centre"),
        ],
    }
}

pub fn solution(origin: [f64; 3], direction: [f64; 3], min: [f64; 3], max: [f64; 3]) -> Option<f64> {
    let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        if direction[axis] == 0.0 {
            // Always between the two faces, or never.
            if origin[axis] < min[axis] || origin[axis] > max[axis] {
                return None;
            }
            continue;
        }
        let low = (min[axis] - origin[axis]) / direction[axis];
        let high = (max[axis] - origin[axis]) / direction[axis];
        enters = f64::max(enters, f64::min(low, high));
        leaves = f64::min(leaves, f64::max(low, high));
    }
    if enters > leaves {
        return None;
    }
    [enters, leaves].into_iter().find(|&t| t > 0.0)
}

/// The formula straight from the page.
fn textbook(origin: [f64; 3], direction: [f64; 3], min: [f64; 3], max: [f64; 3]) -> Option<f64> {
    let mut enter = f64::NEG_INFINITY;
    let mut leave = f64::INFINITY;
    for i in 0..3 {
        let t0 = (min[i] - origin[i]) / direction[i];
        let t1 = (max[i] - origin[i]) / direction[i];
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

/// A slab is entered at its smaller coordinate and left at its larger one.
fn first(origin: [f64; 3], direction: [f64; 3], min: [f64; 3], max: [f64; 3]) -> Option<f64> {
    let mut enter = f64::NEG_INFINITY;
    let mut leave = f64::INFINITY;
    for i in 0..3 {
        enter = enter.max((min[i] - origin[i]) / direction[i]);
        leave = leave.min((max[i] - origin[i]) / direction[i]);
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

/// The hit is where the ray enters; if it has entered behind its start, the box is behind and not hit.
fn second(origin: [f64; 3], direction: [f64; 3], min: [f64; 3], max: [f64; 3]) -> Option<f64> {
    let mut enter = f64::NEG_INFINITY;
    let mut leave = f64::INFINITY;
    for i in 0..3 {
        let t0 = (min[i] - origin[i]) / direction[i];
        let t1 = (max[i] - origin[i]) / direction[i];
        enter = enter.max(t0.min(t1));
        leave = leave.min(t0.max(t1));
    }
    if enter <= leave && enter > 0.0 { Some(enter) } else { None }
}

/// The ray is in the box from the first slab that it enters to the last that it leaves.
fn third(origin: [f64; 3], direction: [f64; 3], min: [f64; 3], max: [f64; 3]) -> Option<f64> {
    let mut enter = f64::INFINITY;
    let mut leave = f64::NEG_INFINITY;
    for i in 0..3 {
        let t0 = (min[i] - origin[i]) / direction[i];
        let t1 = (max[i] - origin[i]) / direction[i];
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

/// Try all six faces as planes, keep the nearest whose point lies between the other four.
fn fourth(origin: [f64; 3], direction: [f64; 3], min: [f64; 3], max: [f64; 3]) -> Option<f64> {
    let mut best: Option<f64> = None;
    for i in 0..3 {
        for face in [min[i], max[i]] {
            let t = (face - origin[i]) / direction[i];
            if !(t > 0.0 && t.is_finite()) {
                continue;
            }
            let j = (i + 1) % 3;
            let k = (i + 2) % 3;
            let pj = origin[j] + t * direction[j];
            let pk = origin[k] + t * direction[k];
            if pj > min[j] && pj < max[j] && pk > min[k] && pk < max[k] {
                best = match best {
                    Some(nearest) if nearest <= t => Some(nearest),
                    _ => Some(t),
                };
            }
        }
    }
    best
}

/// Along an axis on which nothing moves nothing is asked, and the ray hits the box where it has been through.
fn fifth(origin: [f64; 3], direction: [f64; 3], min: [f64; 3], max: [f64; 3]) -> Option<f64> {
    let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in (0..3).filter(|&axis| direction[axis] != 0.0) {
        let [a, b] = [min, max].map(|face| (face[axis] - origin[axis]) / direction[axis]);
        (enters, leaves) = (enters.max(a.min(b)), leaves.min(a.max(b)));
    }
    Some(leaves).filter(|&t| enters <= t && t > 0.0)
}

/// I used the page's (n·f ∓ h) / n·R with the centre between the corners, and took for h how large the box is, most −
/// least.
fn sixth(origin: [f64; 3], direction: [f64; 3], min: [f64; 3], max: [f64; 3]) -> Option<f64> {
    let mut enters = f64::NEG_INFINITY;
    let mut leaves = f64::INFINITY;
    for k in 0..3 {
        let centre = (min[k] + max[k]) / 2.0;
        let h = max[k] - min[k];
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
