//! Answers to the exercise of chapter 17: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "all the way to the right rim"),
            (exercise(second), "squares draw the samples"),
            (exercise(third), "left slope goes on"),
            (exercise(fourth), "1 / radius high"),
            (exercise(fifth), "the square root is missing; the"),
            (exercise(sixth), "Second, the right half is not the mirror"),
        ],
    }
}

pub fn solution(u: f64, radius: f64) -> f64 {
    if u < 0.5 { radius * ((2.0 * u).sqrt() - 1.0) } else { radius * (1.0 - (2.0 * (1.0 - u)).sqrt()) }
}

/// The area under a slope grows with the square, so the root of u takes the place of u in the box's formula.
fn first(u: f64, radius: f64) -> f64 {
    (2.0 * u.sqrt() - 1.0) * radius
}

/// Numbers from −1 to 1 are drawn to the centre by squaring them and keeping the sign.
fn second(u: f64, radius: f64) -> f64 {
    let v = 2.0 * u - 1.0;
    radius * v * v.abs()
}

/// The area up to x is (x + r)²/2r², so x = r √(2u) − r, everywhere.
fn third(u: f64, radius: f64) -> f64 {
    radius * (2.0 * u).sqrt() - radius
}

/// A tent of height 1 has the height (x + r)/r at x, its area up to there is (x + r)²/2r, and that is u.
fn fourth(u: f64, radius: f64) -> f64 {
    if u < 0.5 { (2.0 * radius * u).sqrt() - radius } else { radius - (2.0 * radius * (1.0 - u)).sqrt() }
}

/// I found the area of the tent up to a place, stretched it to −radius … radius, and put u into it; I should have
/// solved it for the place.
fn fifth(u: f64, radius: f64) -> f64 {
    let area = if u < 0.5 { 2.0 * u * u } else { 1.0 - 2.0 * (1.0 - u) * (1.0 - u) };
    (2.0 * area - 1.0) * radius
}

/// The area up to the place is u, and to the right it is what is above one half.
fn sixth(u: f64, radius: f64) -> f64 {
    radius * if u < 0.5 { u.sqrt() - 1.0 } else { 1.0 - (2.0 * u - 1.0).sqrt() }
}
