//! Answers that readers of chapter 07 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "the aspect belongs to x, so x is multiplied by it before 1 is added",
            exercise(a),
            "x is multiplied by the aspect",
        ),
        ("aspect is width / height, and I make it an f64 because x is one", exercise(b), "divides whole numbers"),
        (
            "undo the three steps in the order in which they stand: first the middle, then up, and last the aspect",
            exercise(c),
            "undo the last step first",
        ),
        ("y on the screen is −(2y − 1), so y is −(screen y + 1) / 2", exercise(d), "y has the wrong sign"),
        (
            "the shorter side runs from −1 to 1, so whichever side is longer is divided by how much longer it is",
            exercise(e),
            "shorter side is taken",
        ),
        (
            "NDC run from 0 to 1, so what comes out beyond that must be an error and is clamped",
            exercise(f),
            "onto the image's edge",
        ),
        (
            "I undid the three steps in the order in which they were made: the middle, then the sign, then the aspect.",
            exercise(second_a),
            "in the order in which they were made",
        ),
        (
            "Aspect is width over height; both are whole numbers, and I made the quotient an f64 after dividing.",
            exercise(second_b),
            "the aspect divides whole numbers,",
        ),
        (
            "I remembered that the shorter side runs from −1 to 1, as in PBRT, so that in a tall image it is y that the aspect stretches.",
            exercise(second_c),
            "the shorter side is taken to run",
        ),
    ]
}

fn right(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let aspect = width as f64 / height as f64;
    [(screen[0] / aspect + 1.0) / 2.0, (1.0 - screen[1]) / 2.0]
}

fn a(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let aspect = width as f64 / height as f64;
    [(screen[0] * aspect + 1.0) / 2.0, (1.0 - screen[1]) / 2.0]
}

fn b(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let aspect = (width / height) as f64;
    [(screen[0] / aspect + 1.0) / 2.0, (1.0 - screen[1]) / 2.0]
}

fn c(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let aspect = width as f64 / height as f64;
    [(screen[0] + 1.0) / 2.0 / aspect, (1.0 - screen[1]) / 2.0]
}

fn d(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let aspect = width as f64 / height as f64;
    [(screen[0] / aspect + 1.0) / 2.0, -(screen[1] + 1.0) / 2.0]
}

fn e(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let (w, h) = (width as f64, height as f64);
    let shorter = w.min(h);
    let x = screen[0] / (w / shorter);
    let y = screen[1] / (h / shorter);
    [(x + 1.0) / 2.0, (1.0 - y) / 2.0]
}

fn f(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let aspect = width as f64 / height as f64;
    let x = (screen[0] / aspect + 1.0) / 2.0;
    let y = (1.0 - screen[1]) / 2.0;
    [x.clamp(0.0, 1.0), y.clamp(0.0, 1.0)]
}

fn second_a(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let aspect = width as f64 / height as f64;
    let x = (screen[0] + 1.0) / 2.0;
    let y = (screen[1] + 1.0) / 2.0;
    [x / aspect, -y]
}

fn second_b(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let aspect = (width / height) as f64;
    [(screen[0] / aspect + 1.0) / 2.0, (1.0 - screen[1]) / 2.0]
}

fn second_c(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let aspect = width as f64 / height as f64;
    if aspect >= 1.0 {
        [(screen[0] / aspect + 1.0) / 2.0, (1.0 - screen[1]) / 2.0]
    } else {
        [(screen[0] + 1.0) / 2.0, (1.0 - screen[1] * aspect) / 2.0]
    }
}
