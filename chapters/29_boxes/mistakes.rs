//! Typical wrong solutions of chapter 29, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::enters_box;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(enters_box)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(min_and_max), "pass over NaN"),
        (exercise(|o, i, l, h, _| enters_box(o, i, l, h, f64::INFINITY)), "beyond t_max"),
        (exercise(strictly), "flat boxes and edges are lost"),
        (exercise(lower_first), "upper plane"),
    ]
}

fn min_and_max(o: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let (mut from, mut until) = (0.0, t_max);
    for axis in 0..3 {
        let (a, b) = ((low[axis] - o[axis]) * inverse[axis], (high[axis] - o[axis]) * inverse[axis]);
        from = f64::max(from, f64::min(a, b));
        until = f64::min(until, f64::max(a, b));
    }
    from <= until
}

/// What is touched at one point only is missed.
fn strictly(o: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let (from, until) = interval(o, inverse, low, high, t_max, |axis| inverse[axis].is_sign_negative());
    from < until
}

fn lower_first(o: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let (from, until) = interval(o, inverse, low, high, t_max, |_| false);
    from <= until
}

fn interval(
    o: [f64; 3],
    inverse: [f64; 3],
    low: [f64; 3],
    high: [f64; 3],
    t_max: f64,
    backwards: impl Fn(usize) -> bool,
) -> (f64, f64) {
    let (mut from, mut until) = (0.0, t_max);
    for axis in 0..3 {
        let (near, far) = if backwards(axis) { (high[axis], low[axis]) } else { (low[axis], high[axis]) };
        let (enters, leaves) = ((near - o[axis]) * inverse[axis], (far - o[axis]) * inverse[axis]);
        from = if enters > from { enters } else { from };
        until = if leaves < until { leaves } else { until };
    }
    (from, until)
}
