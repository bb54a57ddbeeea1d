//! Answers to the exercise of chapter 26: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: Some(exercise(textbook)),
        wrong: [
            (exercise(first), "own / other is infinite"),
            (exercise(second), "are swapped"),
            (exercise(third), "balance heuristic squared"),
            (exercise(fourth), "root of the sum"),
            (exercise(fifth), "divided by own"),
            (exercise(sixth), "that is the maximum heuristic"),
        ],
    }
}

pub fn solution(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    let ratio = other / own;
    1.0 / (1.0 + ratio * ratio)
}

/// The formula straight from the page.
fn textbook(own: f64, other: f64) -> f64 {
    own * own / (own * own + other * other)
}

/// Only the ratio counts, so with r = own/other it is r²/(1 + r²), and r² cannot overflow as r is a ratio.
fn first(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    let r = own / other;
    r * r / (1.0 + r * r)
}

/// The weight corrects for what the other technique finds, so other² goes on top.
fn second(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    let r = own / other;
    1.0 / (1.0 + r * r)
}

/// The power heuristic is the square of the balance heuristic.
fn third(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    let w = 1.0 / (1.0 + other / own);
    w * w
}

/// Own over the root of the sum of squares, as one normalises a vector; hypot does not overflow.
fn fourth(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    own / own.hypot(other)
}

/// The estimate is w f/p and the pdf cancels, so I give the weight already divided by my pdf.
fn fifth(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    let r = other / own;
    1.0 / (1.0 + r * r) / own
}

/// Whoever samples the path better shall have all of it.
fn sixth(own: f64, other: f64) -> f64 {
    if own > other { 1.0 } else { 0.0 }
}
