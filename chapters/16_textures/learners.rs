//! Answers that readers of chapter 16 gave who saw its page and nothing else, and words of the remark that each must get.

use super::question::exercise;
use pinhole_lab::exercise::Exercise;

/// The formula straight from the page.
pub fn textbook() -> Exercise {
    exercise(right)
}

/// What each reader thought, and the answer.
pub fn all() -> Vec<(&'static str, Exercise, &'static str)> {
    vec![
        ("the pixel covers the range from x to x + width", exercise(a), "from x to x + width"),
        (
            "the range goes width to the left and width to the right of its middle, so it is divided by twice the width",
            exercise(b),
            "width to either side of x",
        ),
        ("x % 2 is where in the pair of stripes x lies, below 1 it is the white one", exercise(c), "rem_euclid knows"),
        (
            "the mean is the area between the two ends of the range, the zigzag's difference",
            exercise(d),
            "this is the area",
        ),
        (
            "the mean over the pixel is the mean of many points in it, and 1000 should be enough",
            exercise(e),
            "sampled at many points",
        ),
        (
            "the wider the pixel, the greyer: fade the stripe at x to the mean of both, 0, which is reached when the pixel covers a pair of stripes",
            exercise(f),
            "faded by the width alone",
        ),
        (
            "The area grows by the fraction in an even stripe and falls by it in an odd one; I forgot that at the start of an odd stripe 1 has already been gathered.",
            exercise(second_a),
            "that the even stripe before it has gathered",
        ),
        (
            "The zigzag repeats every 2, so I took x % 2 and forgot that this is negative below 0.",
            exercise(second_b),
            "below 0 the remainder or the cast",
        ),
        (
            "The mean over a range is the mean of many points in it, and I thought that a hundred would be enough.",
            exercise(second_c),
            "the range is sampled at many",
        ),
    ]
}

fn right(x: f64, width: f64) -> f64 {
    fn area(x: f64) -> f64 {
        let r = x.rem_euclid(2.0);
        if r < 1.0 { r } else { 2.0 - r }
    }
    if width == 0.0 {
        return if x.rem_euclid(2.0) < 1.0 { 1.0 } else { -1.0 };
    }
    (area(x + width / 2.0) - area(x - width / 2.0)) / width
}

fn a(x: f64, width: f64) -> f64 {
    fn area(x: f64) -> f64 {
        let r = x.rem_euclid(2.0);
        if r < 1.0 { r } else { 2.0 - r }
    }
    if width == 0.0 {
        return if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
    }
    (area(x + width) - area(x)) / width
}

fn b(x: f64, width: f64) -> f64 {
    fn area(x: f64) -> f64 {
        let r = x.rem_euclid(2.0);
        if r < 1.0 { r } else { 2.0 - r }
    }
    if width == 0.0 {
        return if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
    }
    (area(x + width) - area(x - width)) / (2.0 * width)
}

fn c(x: f64, width: f64) -> f64 {
    fn area(x: f64) -> f64 {
        let r = x % 2.0;
        if r < 1.0 { r } else { 2.0 - r }
    }
    if width == 0.0 {
        return if x % 2.0 < 1.0 { 1.0 } else { -1.0 };
    }
    (area(x + width / 2.0) - area(x - width / 2.0)) / width
}

fn d(x: f64, width: f64) -> f64 {
    fn area(x: f64) -> f64 {
        let r = x.rem_euclid(2.0);
        if r < 1.0 { r } else { 2.0 - r }
    }
    if width == 0.0 {
        return if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
    }
    area(x + width / 2.0) - area(x - width / 2.0)
}

fn e(x: f64, width: f64) -> f64 {
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

fn f(x: f64, width: f64) -> f64 {
    let stripe = if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
    let fade = (1.0 - width / 2.0).max(0.0);
    stripe * fade
}

fn second_a(x: f64, width: f64) -> f64 {
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

fn second_b(x: f64, width: f64) -> f64 {
    fn area(x: f64) -> f64 {
        let r = x % 2.0;
        if r < 1.0 { r } else { 2.0 - r }
    }
    if width == 0.0 {
        return if x.floor() % 2.0 == 0.0 { 1.0 } else { -1.0 };
    }
    (area(x + width / 2.0) - area(x - width / 2.0)) / width
}

fn second_c(x: f64, width: f64) -> f64 {
    let mut sum = 0.0;
    for i in 0..100 {
        let place = x + width * ((i as f64 + 0.5) / 100.0 - 0.5);
        if place.floor().rem_euclid(2.0) == 0.0 {
            sum += 1.0;
        } else {
            sum -= 1.0;
        }
    }
    sum / 100.0
}
