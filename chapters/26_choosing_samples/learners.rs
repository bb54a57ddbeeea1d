//! Answers that readers of chapter 26 gave who saw its page and nothing else, and words of the remark that each must get.

use super::question::exercise;
use pinhole_lab::exercise::Exercise;

/// The formula straight from the page.
pub fn textbook() -> Exercise {
    exercise(right)
}

/// What each reader thought, and the answer.
pub fn all() -> Vec<(&'static str, Exercise, &'static str)> {
    vec![
        ("a weight is the fraction of my pdf in the sum of both; the squares cancel", exercise(a), "balance heuristic"),
        (
            "only the ratio counts, so with r = own/other it is r²/(1 + r²), and r² cannot overflow as r is a ratio",
            exercise(b),
            "own / other is infinite",
        ),
        ("the weight corrects for what the other technique finds, so other² goes on top", exercise(c), "are swapped"),
        ("the power heuristic is the square of the balance heuristic", exercise(d), "balance heuristic squared"),
        (
            "own over the root of the sum of squares, as one normalises a vector; hypot does not overflow",
            exercise(e),
            "root of the sum",
        ),
        (
            "the estimate is w f/p and the pdf cancels, so I give the weight already divided by my pdf",
            exercise(f),
            "divided by own",
        ),
        (
            "Only the ratio counts, so I divided everything by one of the two squares and wrote 1/(1 + ratio²), with own over other.",
            exercise(second_a),
            "the two are swapped: the larger pdf",
        ),
        (
            "The power heuristic is the balance heuristic to the power 2, and squared at the end nothing can overflow.",
            exercise(second_b),
            "that is the balance heuristic",
        ),
        (
            "The squares overflow, but hypot gives the root of their sum safely; so own over hypot(own, other).",
            exercise(second_c),
            "the root of the sum of squares",
        ),
    ]
}

fn right(own: f64, other: f64) -> f64 {
    own * own / (own * own + other * other)
}

fn a(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    let larger = own.max(other);
    (own / larger) / (own / larger + other / larger)
}

fn b(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    let r = own / other;
    r * r / (1.0 + r * r)
}

fn c(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    let r = own / other;
    1.0 / (1.0 + r * r)
}

fn d(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    let w = 1.0 / (1.0 + other / own);
    w * w
}

fn e(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    own / own.hypot(other)
}

fn f(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    let r = other / own;
    1.0 / (1.0 + r * r) / own
}

fn second_a(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    let ratio = own / other;
    1.0 / (1.0 + ratio * ratio)
}

fn second_b(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    let larger = own.max(other);
    let balance = (own / larger) / (own / larger + other / larger);
    balance * balance
}

fn second_c(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    own / own.hypot(other)
}
