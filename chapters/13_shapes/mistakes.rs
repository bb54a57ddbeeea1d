//! Typical wrong solutions of chapter 13, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::nearest_box_t;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(nearest_box_t)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|o, d, l, m| passed(o, d, l, m).map(|(near, _)| near)), "behind the origin"),
        (exercise(|o, d, l, m| Some(passed(o, d, l, m)?.0).filter(|&t| t > 0.0)), "from inside"),
        (exercise(|o, d, l, m| Some(passed(o, d, l, m)?.1).filter(|&t| t > 0.0)), "far side"),
        (exercise(min_and_max), "0 by 0"),
        (exercise(first_entered), "last slab"),
    ]
}

/// Where a ray is inside a box, whatever lies behind it.
fn passed(o: [f64; 3], d: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<(f64, f64)> {
    let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        if d[axis] == 0.0 {
            if o[axis] < least[axis] || o[axis] > most[axis] {
                return None;
            }
            continue;
        }
        let (a, b) = ((least[axis] - o[axis]) / d[axis], (most[axis] - o[axis]) / d[axis]);
        (near, far) = (near.max(a.min(b)), far.min(a.max(b)));
    }
    (near <= far).then_some((near, far))
}

/// Nothing asked beforehand: rays in the plane of a face divide 0 by 0.
fn min_and_max(o: [f64; 3], d: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<f64> {
    let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let (a, b) = ((least[axis] - o[axis]) / d[axis], (most[axis] - o[axis]) / d[axis]);
        let (first, last) = if a < b { (a, b) } else { (b, a) };
        near = if first > near { first } else { near };
        far = if last < far { last } else { far };
        if near > far || near.is_nan() || far.is_nan() || first.is_nan() {
            return None;
        }
    }
    [near, far].into_iter().find(|&t| t > 0.0)
}

fn first_entered(o: [f64; 3], d: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<f64> {
    passed(o, d, least, most)?;
    let near = |axis: usize| ((least[axis] - o[axis]) / d[axis]).min((most[axis] - o[axis]) / d[axis]);
    (0..3).filter(|&axis| d[axis] != 0.0).map(near).filter(|&t| t > 0.0).reduce(f64::min)
}
