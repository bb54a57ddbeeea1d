//! Answers that readers of chapter 19 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "the page says R − 2(R·n)n, so I write just that, with the normal that I am given",
            exercise(a),
            "divide by n · n",
        ),
        (
            "the normal has some length, so I divide by that length (once; it stands in the formula twice)",
            exercise(b),
            "length once",
        ),
        (
            "take the part along the normal away from the direction (once), and what is left goes on",
            exercise(c),
            "2 is missing",
        ),
        (
            "reflected light always goes to the side of the normal, so I add twice the absolute value of the cosine",
            exercise(d),
            "from behind",
        ),
        (
            "I remember 2(L·n)n − L from Phong's highlight and use it, though there L points to the light",
            exercise(e),
            "goes into the mirror",
        ),
        (
            "if the normal's length is wrong so is the result's, so it is enough to normalise the result",
            exercise(f),
            "normalised instead",
        ),
        (
            "The cosine needs a unit normal, so I divide the dot product by the length, once; the n it multiplies I left as it came.",
            exercise(second_a),
            "what comes out is divided by the",
        ),
        (
            "The normal may be on either side, so I take the absolute value of the cosine and push the ray out along n by twice that.",
            exercise(second_b),
            "from behind a mirror works too; no",
        ),
        (
            "I take the part along the normal away (once), and since the result is then too short I make its length 1 again.",
            exercise(second_c),
            "normalising does not replace it",
        ),
    ]
}

fn right(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let l = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
    let n = [normal[0] / l, normal[1] / l, normal[2] / l];
    let k = 2.0 * (direction[0] * n[0] + direction[1] * n[1] + direction[2] * n[2]);
    [direction[0] - k * n[0], direction[1] - k * n[1], direction[2] - k * n[2]]
}

fn a(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let k = 2.0 * (direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
    [direction[0] - k * normal[0], direction[1] - k * normal[1], direction[2] - k * normal[2]]
}

fn b(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let l = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
    let k = 2.0 * (direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]) / l;
    [direction[0] - k * normal[0], direction[1] - k * normal[1], direction[2] - k * normal[2]]
}

fn c(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let l = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
    let n = [normal[0] / l, normal[1] / l, normal[2] / l];
    let k = direction[0] * n[0] + direction[1] * n[1] + direction[2] * n[2];
    [direction[0] - k * n[0], direction[1] - k * n[1], direction[2] - k * n[2]]
}

fn d(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let l = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
    let n = [normal[0] / l, normal[1] / l, normal[2] / l];
    let k = 2.0 * (direction[0] * n[0] + direction[1] * n[1] + direction[2] * n[2]).abs();
    [direction[0] + k * n[0], direction[1] + k * n[1], direction[2] + k * n[2]]
}

fn e(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let l2 = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    let k = 2.0 * (direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]) / l2;
    [k * normal[0] - direction[0], k * normal[1] - direction[1], k * normal[2] - direction[2]]
}

fn f(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let k = 2.0 * (direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
    let r = [direction[0] - k * normal[0], direction[1] - k * normal[1], direction[2] - k * normal[2]];
    let l = (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt();
    [r[0] / l, r[1] / l, r[2] / l]
}

fn second_a(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let length = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
    let cosine = (direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]) / length;
    [
        direction[0] - 2.0 * cosine * normal[0],
        direction[1] - 2.0 * cosine * normal[1],
        direction[2] - 2.0 * cosine * normal[2],
    ]
}

fn second_b(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let length = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
    let n = [normal[0] / length, normal[1] / length, normal[2] / length];
    let cosine = (direction[0] * n[0] + direction[1] * n[1] + direction[2] * n[2]).abs();
    [direction[0] + 2.0 * cosine * n[0], direction[1] + 2.0 * cosine * n[1], direction[2] + 2.0 * cosine * n[2]]
}

fn second_c(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let squared = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    let along = (direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]) / squared;
    let r = [direction[0] - along * normal[0], direction[1] - along * normal[1], direction[2] - along * normal[2]];
    let length = (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt();
    [r[0] / length, r[1] / length, r[2] / length]
}
