//! Answers to the exercise of chapter 29: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: Some(exercise(textbook)),
        wrong: [
            (exercise(first), "flat boxes and edges are lost"),
            (exercise(second), "beyond t_max"),
            (exercise(third), "smallest entry"),
            (exercise(fourth), "enters by the upper plane"),
            (exercise(fifth), "it is divided by `inverse`, which"),
            (exercise(sixth), "at a t of its own"),
        ],
    }
}

pub fn solution(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let (mut from, mut until) = (0.0, t_max);
    for axis in 0..3 {
        let (near, far) =
            if inverse[axis].is_sign_negative() { (high[axis], low[axis]) } else { (low[axis], high[axis]) };
        let enters = (near - origin[axis]) * inverse[axis];
        let leaves = (far - origin[axis]) * inverse[axis];
        // 0 · ∞ is NaN, with which every comparison is false: then this slab leaves the interval as it is.
        if enters > from {
            from = enters;
        }
        if leaves < until {
            until = leaves;
        }
    }
    from <= until
}

/// The formula straight from the page.
fn textbook(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let mut enter = 0.0_f64;
    let mut leave = t_max;
    for i in 0..3 {
        let t0 = (low[i] - origin[i]) * inverse[i];
        let t1 = (high[i] - origin[i]) * inverse[i];
        enter = enter.max(t0.min(t1));
        leave = leave.min(t0.max(t1));
    }
    enter <= leave
}

/// A ray that enters and leaves at the same t is not in the box for any time, so the comparison is <.
fn first(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let mut enter = 0.0_f64;
    let mut leave = t_max;
    for i in 0..3 {
        let forward = inverse[i] > 0.0;
        let (near, far) = if forward { (low[i], high[i]) } else { (high[i], low[i]) };
        enter = enter.max((near - origin[i]) * inverse[i]);
        leave = leave.min((far - origin[i]) * inverse[i]);
    }
    enter < leave
}

/// The box is hit if the interval is not empty and ends ahead of the origin; how far away it begins is not the box's
/// business (t_max forgotten).
fn second(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let _ = t_max;
    let mut enter = f64::NEG_INFINITY;
    let mut leave = f64::INFINITY;
    for i in 0..3 {
        let (near, far) = if inverse[i] > 0.0 { (low[i], high[i]) } else { (high[i], low[i]) };
        enter = enter.max((near - origin[i]) * inverse[i]);
        leave = leave.min((far - origin[i]) * inverse[i]);
    }
    enter <= leave && leave >= 0.0
}

/// The ray is in the box from the first entry to the last exit (smallest and largest exchanged).
fn third(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let mut enter = f64::INFINITY;
    let mut leave = f64::NEG_INFINITY;
    for i in 0..3 {
        let (near, far) = if inverse[i] > 0.0 { (low[i], high[i]) } else { (high[i], low[i]) };
        enter = enter.min((near - origin[i]) * inverse[i]);
        leave = leave.max((far - origin[i]) * inverse[i]);
    }
    enter.max(0.0) <= leave.min(t_max)
}

/// The low face is the entry and the high one the exit, since low is always the smaller.
fn fourth(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let mut enter = 0.0_f64;
    let mut leave = t_max;
    for i in 0..3 {
        enter = enter.max((low[i] - origin[i]) * inverse[i]);
        leave = leave.min((high[i] - origin[i]) * inverse[i]);
    }
    enter <= leave
}

/// The formula divides by the direction, so I divided by the array I was given, and did not notice that it is the
/// inverse already.
fn fifth(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let mut near = 0.0_f64;
    let mut far = t_max;
    for i in 0..3 {
        let first = (low[i] - origin[i]) / inverse[i];
        let second = (high[i] - origin[i]) / inverse[i];
        let (enter, leave) = if first <= second { (first, second) } else { (second, first) };
        if enter > near {
            near = enter;
        }
        if leave < far {
            far = leave;
        }
    }
    near <= far
}

/// The ray hits the box if it is in every one of the three slabs at some t from 0 to t_max, so I checked slab after
/// slab.
fn sixth(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    for i in 0..3 {
        let (front, back) = if inverse[i].is_sign_negative() { (high[i], low[i]) } else { (low[i], high[i]) };
        let enter = (front - origin[i]) * inverse[i];
        let leave = (back - origin[i]) * inverse[i];
        if enter > t_max || leave < 0.0 {
            return false;
        }
    }
    true
}
