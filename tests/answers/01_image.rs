//! Answers to the exercise of chapter 01: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "are swapped"),
            (exercise(second), "which gives NDC"),
            (exercise(third), "f32 is computed in"),
            (exercise(fourth), "y is the index over the width with"),
            (exercise(fifth), "rows are taken to be one pixel"),
            (exercise(sixth), "Second, y is the index over the width"),
        ],
    }
}

pub fn solution(index: u64, width: u32) -> [f64; 2] {
    let width = u64::from(width);
    [(index % width) as f64 + 0.5, (index / width) as f64 + 0.5]
}

/// Dividing by the width tells how far across one is, and the remainder how far down.
fn first(index: u64, width: u32) -> [f64; 2] {
    let w = width as u64;
    [(index / w) as f64 + 0.5, (index % w) as f64 + 0.5]
}

/// The place must not depend on the resolution, so I divide by the width as in the formula for NDC.
fn second(index: u64, width: u32) -> [f64; 2] {
    let w = width as u64;
    let x = (index % w) as f64 + 0.5;
    let y = (index / w) as f64 + 0.5;
    [x / width as f64, y / width as f64]
}

/// F32 is what graphics uses, so I turn index and width into f32 first and floor the quotient.
fn third(index: u64, width: u32) -> [f64; 2] {
    let n = index as f32;
    let w = width as f32;
    let row = (n / w).floor();
    let column = n - row * w;
    [(column + 0.5) as f64, (row + 0.5) as f64]
}

/// The row is the number divided by the width, so I divided as f64 so as to lose nothing, and did not think that what
/// follows the point has to go.
fn fourth(index: u64, width: u32) -> [f64; 2] {
    let column = (index % width as u64) as f64;
    let row = index as f64 / width as f64;
    [column + 0.5, row + 0.5]
}

/// Pixels are counted from 0, so the last of a row is W − 1 and that is what I divide by.
fn fifth(index: u64, width: u32) -> [f64; 2] {
    let last = (width as u64 - 1).max(1);
    let i = index % last;
    let j = index / last;
    [i as f64 + 0.5, j as f64 + 0.5]
}

/// The index counts along x, and over the width it tells how far down that is.
fn sixth(index: u64, width: u32) -> [f64; 2] {
    let index = index as f64;
    [index + 0.5, index / width as f64 + 0.5]
}
