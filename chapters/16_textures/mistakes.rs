//! Typical wrong solutions of chapter 16, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::mean_of_stripes;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(mean_of_stripes)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|x, _| stripe(x)), "the stripe at x itself"),
        (exercise(|x, w| stripes_between(x, x + w, w)), "either side"),
        (exercise(|x, w| stripes_between(x - w, x + w, 2.0 * w)), "twice as wide"),
        (exercise(|x, w| (zigzag(x + w / 2.0) - zigzag(x - w / 2.0)) / w), "without width"),
        (exercise(|x, w| stripes_between(x - w / 2.0, x + w / 2.0, 1.0)), "the area"),
        (exercise(|x, w| -stripes_between(x - w / 2.0, x + w / 2.0, w)), "the reverse"),
    ]
}

fn stripe(x: f64) -> f64 {
    if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 }
}

fn zigzag(x: f64) -> f64 {
    1.0 - (x.rem_euclid(2.0) - 1.0).abs()
}

/// The area under the stripes over a number, or the stripe itself where there is no area.
fn stripes_between(low: f64, high: f64, over: f64) -> f64 {
    if low == high { stripe(low) } else { (zigzag(high) - zigzag(low)) / over }
}
