//! Answers that readers of chapter 17 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "the area under a slope grows with the square, so the root of u takes the place of u in the box's formula",
            exercise(a),
            "all the way to the right rim",
        ),
        (
            "numbers from −1 to 1 are drawn to the centre by squaring them and keeping the sign",
            exercise(b),
            "squares draw the samples",
        ),
        (
            "numbers from −1 to 1, and the inverse of a square is a root, so the root with the sign kept",
            exercise(c),
            "not from the rim",
        ),
        ("the area up to x is (x + r)²/2r², so x = r √(2u) − r, everywhere", exercise(d), "left slope goes on"),
        (
            "the lower half of the numbers makes the left slope; for the right one I stretch the upper half to 0 to 1 and mirror the left slope",
            exercise(e),
            "not the mirror image",
        ),
        (
            "a tent of height 1 has the height (x + r)/r at x, its area up to there is (x + r)²/2r, and that is u",
            exercise(f),
            "1 / radius high",
        ),
        (
            "The area under a straight line is a square, so I take a root of how far u is from the middle, with its sign.",
            exercise(second_a),
            "counted from the centre, not from the rim",
        ),
        (
            "More samples should be near the centre, so I took the box's place from −1 to 1 and squared it, keeping its sign.",
            exercise(second_b),
            "squares draw the samples to the",
        ),
        (
            "I found the area of the tent up to a place, stretched it to −radius … radius, and put u into it; I should have solved it for the place.",
            exercise(second_c),
            "the square root is missing; the",
        ),
    ]
}

fn right(u: f64, radius: f64) -> f64 {
    if u < 0.5 { radius * ((2.0 * u).sqrt() - 1.0) } else { radius * (1.0 - (2.0 * (1.0 - u)).sqrt()) }
}

fn a(u: f64, radius: f64) -> f64 {
    (2.0 * u.sqrt() - 1.0) * radius
}

fn b(u: f64, radius: f64) -> f64 {
    let v = 2.0 * u - 1.0;
    radius * v * v.abs()
}

fn c(u: f64, radius: f64) -> f64 {
    let v = 2.0 * u - 1.0;
    if v < 0.0 { -radius * (-v).sqrt() } else { radius * v.sqrt() }
}

fn d(u: f64, radius: f64) -> f64 {
    radius * (2.0 * u).sqrt() - radius
}

fn e(u: f64, radius: f64) -> f64 {
    if u < 0.5 {
        radius * ((2.0 * u).sqrt() - 1.0)
    } else {
        let v = 2.0 * u - 1.0;
        -(radius * (v.sqrt() - 1.0))
    }
}

fn f(u: f64, radius: f64) -> f64 {
    if u < 0.5 { (2.0 * radius * u).sqrt() - radius } else { radius - (2.0 * radius * (1.0 - u)).sqrt() }
}

fn second_a(u: f64, radius: f64) -> f64 {
    if u < 0.5 { -radius * (1.0 - 2.0 * u).sqrt() } else { radius * (2.0 * u - 1.0).sqrt() }
}

fn second_b(u: f64, radius: f64) -> f64 {
    let place = 2.0 * u - 1.0;
    radius * place * place.abs()
}

fn second_c(u: f64, radius: f64) -> f64 {
    let area = if u < 0.5 { 2.0 * u * u } else { 1.0 - 2.0 * (1.0 - u) * (1.0 - u) };
    (2.0 * area - 1.0) * radius
}
