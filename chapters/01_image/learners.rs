//! Answers that readers of chapter 01 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "the first pixel of the file is number 1, so I take one off before I split the number into row and column",
            exercise(a),
            "pixels are counted from 1",
        ),
        (
            "dividing by the width tells how far across one is, and the remainder how far down",
            exercise(b),
            "are swapped",
        ),
        (
            "y is the index over the width, computed in f64 so that nothing is lost, plus the half",
            exercise(c),
            "rows are counted whole",
        ),
        (
            "the number names the square's left edge, so the half is needed in x; a row's number is already its height",
            exercise(d),
            "half is missing in y",
        ),
        (
            "the place must not depend on the resolution, so I divide by the width as in the formula for NDC",
            exercise(e),
            "which gives NDC",
        ),
        (
            "f32 is what graphics uses, so I turn index and width into f32 first and floor the quotient",
            exercise(f),
            "f32 is computed in",
        ),
        (
            "The row is the number divided by the width, so I divided as f64 so as to lose nothing, and did not think that what follows the point has to go.",
            exercise(second_a),
            "y is the index over the width with",
        ),
        (
            "The centre is half a pixel further on, so I added the half to the running number first and then split it into column and row.",
            exercise(second_b),
            "the half is missing in y: a row is",
        ),
        (
            "Pixels are counted from 0, so the last of a row is W − 1 and that is what I divide by.",
            exercise(second_c),
            "rows are taken to be one pixel",
        ),
    ]
}

fn right(index: u64, width: u32) -> [f64; 2] {
    let i = index % width as u64;
    let j = index / width as u64;
    [i as f64 + 0.5, j as f64 + 0.5]
}

fn a(index: u64, width: u32) -> [f64; 2] {
    let n = index.saturating_sub(1);
    let w = width as u64;
    [(n % w) as f64 + 0.5, (n / w) as f64 + 0.5]
}

fn b(index: u64, width: u32) -> [f64; 2] {
    let w = width as u64;
    [(index / w) as f64 + 0.5, (index % w) as f64 + 0.5]
}

fn c(index: u64, width: u32) -> [f64; 2] {
    let column = index % width as u64;
    [column as f64 + 0.5, index as f64 / width as f64 + 0.5]
}

fn d(index: u64, width: u32) -> [f64; 2] {
    let w = width as u64;
    [(index % w) as f64 + 0.5, (index / w) as f64]
}

fn e(index: u64, width: u32) -> [f64; 2] {
    let w = width as u64;
    let x = (index % w) as f64 + 0.5;
    let y = (index / w) as f64 + 0.5;
    [x / width as f64, y / width as f64]
}

fn f(index: u64, width: u32) -> [f64; 2] {
    let n = index as f32;
    let w = width as f32;
    let row = (n / w).floor();
    let column = n - row * w;
    [(column + 0.5) as f64, (row + 0.5) as f64]
}

fn second_a(index: u64, width: u32) -> [f64; 2] {
    let column = (index % width as u64) as f64;
    let row = index as f64 / width as f64;
    [column + 0.5, row + 0.5]
}

fn second_b(index: u64, width: u32) -> [f64; 2] {
    let centre = index as f64 + 0.5;
    let w = width as f64;
    [centre % w, (centre / w).floor()]
}

fn second_c(index: u64, width: u32) -> [f64; 2] {
    let last = (width as u64 - 1).max(1);
    let i = index % last;
    let j = index / last;
    [i as f64 + 0.5, j as f64 + 0.5]
}
