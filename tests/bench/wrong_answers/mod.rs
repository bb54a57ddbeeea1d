//! Wrong answers to the chapters' exercises with words of the remark that each must get, and right ones that look
//! unlike the book's; all written from the pages, before looking at what is known.

mod from_01;
mod from_08;
mod from_15;
mod from_22;
mod from_29;
#[allow(dead_code, reason = "for the bench alone")]
mod latest;

use pinhole_lab::exercise::Exercise;

/// Answers to a chapter's exercise.
pub struct Fresh {
    /// The chapter's number.
    pub chapter: usize,
    /// Wrong ones, with words of what must be said of each; without words, where it has no name yet.
    pub wrong: Vec<(Exercise, &'static str)>,
    /// Right ones.
    pub right: Vec<Exercise>,
}

/// Those that were written last.
#[allow(dead_code, reason = "for the bench alone")]
pub fn latest() -> Vec<Fresh> {
    latest::all()
}

/// Of all chapters.
pub fn all() -> Vec<Fresh> {
    [from_01::all(), from_08::all(), from_15::all(), from_22::all(), from_29::all()].into_iter().flatten().collect()
}

fn fresh<F: Copy>(chapter: usize, exercise: fn(F) -> Exercise, wrong: &[(&'static str, F)], right: &[F]) -> Fresh {
    let wrong = wrong.iter().map(|&(words, answer)| (exercise(answer), words)).collect();
    Fresh { chapter, wrong, right: right.iter().map(|&answer| exercise(answer)).collect() }
}

type Vector = [f64; 3];

fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn times(v: Vector, factor: f64) -> Vector {
    v.map(|part| part * factor)
}

fn over(v: Vector, divisor: f64) -> Vector {
    v.map(|part| part / divisor)
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn length(v: Vector) -> f64 {
    dot(v, v).sqrt()
}

fn unit(v: Vector) -> Vector {
    over(v, length(v))
}
