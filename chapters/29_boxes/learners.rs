//! Answers that readers of chapter 29 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "a ray that enters and leaves at the same t is not in the box for any time, so the comparison is <",
            exercise(a),
            "flat boxes and edges are lost",
        ),
        (
            "the largest entry and the smallest exit start at −∞ and t_max (boxes behind the origin count)",
            exercise(b),
            "box behind the origin",
        ),
        (
            "where the direction is 0 I ask instead whether the origin lies between the faces, that is above the low one and below the high one (faces excluded)",
            exercise(c),
            "plane of a face is lost",
        ),
        (
            "the box is hit if the interval is not empty and ends ahead of the origin; how far away it begins is not the box's business (t_max forgotten)",
            exercise(d),
            "beyond t_max",
        ),
        (
            "the ray is in the box from the first entry to the last exit (smallest and largest exchanged)",
            exercise(e),
            "smallest entry",
        ),
        (
            "the low face is the entry and the high one the exit, since low is always the smaller",
            exercise(f),
            "enters by the upper plane",
        ),
        (
            "The formula divides by the direction, so I divided by the array I was given, and did not notice that it is the inverse already.",
            exercise(second_a),
            "it is divided by `inverse`, which",
        ),
        (
            "The ray enters the box at the first of the entries and leaves it at the last of the exits.",
            exercise(second_b),
            "the smallest entry and the largest",
        ),
        (
            "The ray hits the box if it is in every one of the three slabs at some t from 0 to t_max, so I checked slab after slab.",
            exercise(second_c),
            "at a t of its own",
        ),
    ]
}

fn right(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
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

fn a(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
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

fn b(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let mut enter = f64::NEG_INFINITY;
    let mut leave = t_max;
    for i in 0..3 {
        let (near, far) = if inverse[i] > 0.0 { (low[i], high[i]) } else { (high[i], low[i]) };
        enter = enter.max((near - origin[i]) * inverse[i]);
        leave = leave.min((far - origin[i]) * inverse[i]);
    }
    enter <= leave
}

fn c(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let mut enter = 0.0_f64;
    let mut leave = t_max;
    for i in 0..3 {
        if inverse[i].is_infinite() {
            if origin[i] <= low[i] || origin[i] >= high[i] {
                return false;
            }
            continue;
        }
        let t0 = (low[i] - origin[i]) * inverse[i];
        let t1 = (high[i] - origin[i]) * inverse[i];
        enter = enter.max(t0.min(t1));
        leave = leave.min(t0.max(t1));
    }
    enter <= leave
}

fn d(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
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

fn e(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let mut enter = f64::INFINITY;
    let mut leave = f64::NEG_INFINITY;
    for i in 0..3 {
        let (near, far) = if inverse[i] > 0.0 { (low[i], high[i]) } else { (high[i], low[i]) };
        enter = enter.min((near - origin[i]) * inverse[i]);
        leave = leave.max((far - origin[i]) * inverse[i]);
    }
    enter.max(0.0) <= leave.min(t_max)
}

fn f(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let mut enter = 0.0_f64;
    let mut leave = t_max;
    for i in 0..3 {
        enter = enter.max((low[i] - origin[i]) * inverse[i]);
        leave = leave.min((high[i] - origin[i]) * inverse[i]);
    }
    enter <= leave
}

fn second_a(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
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

fn second_b(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    let mut near = f64::INFINITY;
    let mut far = f64::NEG_INFINITY;
    for i in 0..3 {
        let (front, back) = if inverse[i].is_sign_negative() { (high[i], low[i]) } else { (low[i], high[i]) };
        let enter = (front - origin[i]) * inverse[i];
        let leave = (back - origin[i]) * inverse[i];
        if enter < near {
            near = enter;
        }
        if leave > far {
            far = leave;
        }
    }
    near <= far && near <= t_max && far >= 0.0
}

fn second_c(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
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
