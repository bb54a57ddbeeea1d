//! Answers to the exercise of chapter 07: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "x is multiplied by the aspect"),
            (exercise(second), "divides whole numbers"),
            (exercise(third), "shorter side is taken"),
            (exercise(fourth), "onto the image's edge"),
            (exercise(fifth), "in the order in which they were made"),
            (exercise(sixth), "Second, y is not turned over"),
        ],
    }
}

pub fn solution(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let aspect = f64::from(width) / f64::from(height);
    [(screen[0] / aspect + 1.0) / 2.0, (1.0 - screen[1]) / 2.0]
}

/// The aspect belongs to x, so x is multiplied by it before 1 is added.
fn first(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let aspect = width as f64 / height as f64;
    [(screen[0] * aspect + 1.0) / 2.0, (1.0 - screen[1]) / 2.0]
}

/// Aspect is width / height, and I make it an f64 because x is one.
fn second(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let aspect = (width / height) as f64;
    [(screen[0] / aspect + 1.0) / 2.0, (1.0 - screen[1]) / 2.0]
}

/// The shorter side runs from −1 to 1, so whichever side is longer is divided by how much longer it is.
fn third(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let (w, h) = (width as f64, height as f64);
    let shorter = w.min(h);
    let x = screen[0] / (w / shorter);
    let y = screen[1] / (h / shorter);
    [(x + 1.0) / 2.0, (1.0 - y) / 2.0]
}

/// NDC run from 0 to 1, so what comes out beyond that must be an error and is clamped.
fn fourth(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let aspect = width as f64 / height as f64;
    let x = (screen[0] / aspect + 1.0) / 2.0;
    let y = (1.0 - screen[1]) / 2.0;
    [x.clamp(0.0, 1.0), y.clamp(0.0, 1.0)]
}

/// I undid the three steps in the order in which they were made: the middle, then the sign, then the aspect.
fn fifth(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let aspect = width as f64 / height as f64;
    let x = (screen[0] + 1.0) / 2.0;
    let y = (screen[1] + 1.0) / 2.0;
    [x / aspect, -y]
}

/// Both run from −1 to 1, so 1 is added to both and the sum halved.
fn sixth(screen: [f64; 2], _: u32, _: u32) -> [f64; 2] {
    screen.map(|part| (part + 1.0) / 2.0)
}
