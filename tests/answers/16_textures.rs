//! Answers to the exercise of chapter 16: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "width to either side of x"),
            (exercise(second), "rem_euclid knows"),
            (exercise(third), "this is the area"),
            (exercise(fourth), "sampled at many points"),
            (exercise(fifth), "faded by the width alone"),
            (exercise(sixth), "that the even stripe before it has gathered"),
        ],
    }
}

pub fn solution(x: f64, width: f64) -> f64 {
    if width == 0.0 {
        return if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
    }
    let area = |x: f64| 1.0 - (x.rem_euclid(2.0) - 1.0).abs();
    (area(x + width / 2.0) - area(x - width / 2.0)) / width
}

/// The range goes width to the left and width to the right of its middle, so it is divided by twice the width.
fn first(x: f64, width: f64) -> f64 {
    fn area(x: f64) -> f64 {
        let r = x.rem_euclid(2.0);
        if r < 1.0 { r } else { 2.0 - r }
    }
    if width == 0.0 {
        return if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
    }
    (area(x + width) - area(x - width)) / (2.0 * width)
}

/// X % 2 is where in the pair of stripes x lies, below 1 it is the white one.
fn second(x: f64, width: f64) -> f64 {
    fn area(x: f64) -> f64 {
        let r = x % 2.0;
        if r < 1.0 { r } else { 2.0 - r }
    }
    if width == 0.0 {
        return if x % 2.0 < 1.0 { 1.0 } else { -1.0 };
    }
    (area(x + width / 2.0) - area(x - width / 2.0)) / width
}

/// The mean is the area between the two ends of the range, the zigzag's difference.
fn third(x: f64, width: f64) -> f64 {
    fn area(x: f64) -> f64 {
        let r = x.rem_euclid(2.0);
        if r < 1.0 { r } else { 2.0 - r }
    }
    if width == 0.0 {
        return if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
    }
    area(x + width / 2.0) - area(x - width / 2.0)
}

/// The mean over the pixel is the mean of many points in it, and 1000 should be enough.
fn fourth(x: f64, width: f64) -> f64 {
    let mut sum = 0.0f64;
    for i in 0..1000 {
        let p = x - width / 2.0 + width * (i as f64 + 0.5) / 1000.0;
        if p.floor().rem_euclid(2.0) == 0.0 {
            sum += 1.0;
        } else {
            sum -= 1.0;
        }
    }
    sum / 1000.0
}

/// The wider the pixel, the greyer: fade the stripe at x to the mean of both, 0, which is reached when the pixel
/// covers a pair of stripes.
fn fifth(x: f64, width: f64) -> f64 {
    let stripe = if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
    let fade = (1.0 - width / 2.0).max(0.0);
    stripe * fade
}

/// The area grows by the fraction in an even stripe and falls by it in an odd one; I forgot that at the start of an
/// odd stripe 1 has already been gathered.
fn sixth(x: f64, width: f64) -> f64 {
    fn area(x: f64) -> f64 {
        let cell = x.floor();
        let fraction = x - cell;
        if cell.rem_euclid(2.0) == 0.0 { fraction } else { -fraction }
    }
    if width == 0.0 {
        return if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
    }
    (area(x + width / 2.0) - area(x - width / 2.0)) / width
}
