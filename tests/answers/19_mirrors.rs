//! Answers to the exercise of chapter 19: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "divide by n · n"),
            (exercise(second), "length once"),
            (exercise(third), "2 is missing"),
            (exercise(fourth), "normalised instead"),
            (exercise(fifth), "from behind a mirror works too; no"),
            (exercise(sixth), "normalising does not replace it"),
        ],
    }
}

pub fn solution(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let twice = 2.0 * dot(direction, normal) / dot(normal, normal);
    [0, 1, 2].map(|part| direction[part] - twice * normal[part])
}

/// The page says R − 2(R·n)n, so I write just that, with the normal that I am given.
fn first(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let k = 2.0 * (direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
    [direction[0] - k * normal[0], direction[1] - k * normal[1], direction[2] - k * normal[2]]
}

/// The normal has some length, so I divide by that length (once; it stands in the formula twice).
fn second(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let l = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
    let k = 2.0 * (direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]) / l;
    [direction[0] - k * normal[0], direction[1] - k * normal[1], direction[2] - k * normal[2]]
}

/// Take the part along the normal away from the direction (once), and what is left goes on.
fn third(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let l = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
    let n = [normal[0] / l, normal[1] / l, normal[2] / l];
    let k = direction[0] * n[0] + direction[1] * n[1] + direction[2] * n[2];
    [direction[0] - k * n[0], direction[1] - k * n[1], direction[2] - k * n[2]]
}

/// If the normal's length is wrong so is the result's, so it is enough to normalise the result.
fn fourth(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let k = 2.0 * (direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
    let r = [direction[0] - k * normal[0], direction[1] - k * normal[1], direction[2] - k * normal[2]];
    let l = (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt();
    [r[0] / l, r[1] / l, r[2] / l]
}

/// The normal may be on either side, so I take the absolute value of the cosine and push the ray out along n by twice
/// that.
fn fifth(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let length = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
    let n = [normal[0] / length, normal[1] / length, normal[2] / length];
    let cosine = (direction[0] * n[0] + direction[1] * n[1] + direction[2] * n[2]).abs();
    [direction[0] + 2.0 * cosine * n[0], direction[1] + 2.0 * cosine * n[1], direction[2] + 2.0 * cosine * n[2]]
}

/// I take the part along the normal away (once), and since the result is then too short I make its length 1 again.
fn sixth(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let squared = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    let along = (direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]) / squared;
    let r = [direction[0] - along * normal[0], direction[1] - along * normal[1], direction[2] - along * normal[2]];
    let length = (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt();
    [r[0] / length, r[1] / length, r[2] / length]
}
