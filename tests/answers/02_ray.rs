//! Answers to the exercise of chapter 02: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: Some(exercise(textbook)),
        wrong: [
            (exercise(first), "|x| + |y| + |z|"),
            (exercise(second), "square root is missing"),
            (exercise(third), "makes that part 1"),
            (exercise(fourth), "length itself overflows"),
            (exercise(fifth), "one part that is 0"),
            (exercise(sixth), "the largest part is taken with its"),
        ],
    }
}

pub fn solution(v: [f64; 3]) -> Option<[f64; 3]> {
    let largest = v[0].abs().max(v[1].abs()).max(v[2].abs());
    if !v.iter().all(|part| part.is_finite()) || largest == 0.0 {
        return None;
    }
    let [x, y, z] = v.map(|part| part / largest);
    let length = (x * x + y * y + z * z).sqrt();
    Some([x / length, y / length, z / length])
}

/// The formula straight from the page.
fn textbook(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    if length > 0.0 && length.is_finite() { Some([v[0] / length, v[1] / length, v[2] / length]) } else { None }
}

/// The length is how far one walks along the three axes together, and sums of absolute values cannot overflow.
fn first(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = v[0].abs() + v[1].abs() + v[2].abs();
    if length > 0.0 && length.is_finite() { Some([v[0] / length, v[1] / length, v[2] / length]) } else { None }
}

/// V·v is the length (I forgot that it is the length squared).
fn second(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if length == 0.0 || !length.is_finite() {
        return None;
    }
    Some(v.map(|part| part / length))
}

/// The page says to divide by the largest part, then the largest is 1, so that must be length 1.
fn third(v: [f64; 3]) -> Option<[f64; 3]> {
    let largest = v[0].abs().max(v[1].abs()).max(v[2].abs());
    if v.iter().any(|part| !part.is_finite()) || largest == 0.0 {
        return None;
    }
    Some([v[0] / largest, v[1] / largest, v[2] / largest])
}

/// Hypot never overflows, so hypot of hypot is safe for everything that the comment asks for.
fn fourth(v: [f64; 3]) -> Option<[f64; 3]> {
    if !(v[0].is_finite() && v[1].is_finite() && v[2].is_finite()) {
        return None;
    }
    let length = v[0].hypot(v[1]).hypot(v[2]);
    if length == 0.0 {
        return None;
    }
    Some([v[0] / length, v[1] / length, v[2] / length])
}

/// A vector is 0 if a part of it is 0, so I return None as soon as I find a 0.
fn fifth(v: [f64; 3]) -> Option<[f64; 3]> {
    for part in v {
        if part == 0.0 || !part.is_finite() {
            return None;
        }
    }
    let largest = v[0].abs().max(v[1].abs()).max(v[2].abs());
    let s = v.map(|part| part / largest);
    let length = (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]).sqrt();
    Some(s.map(|part| part / length))
}

/// The largest part is the maximum of the three; I forgot that parts can be negative, so that the 'largest' may be 0
/// or turn the vector round.
fn sixth(v: [f64; 3]) -> Option<[f64; 3]> {
    if !v.iter().all(|part| part.is_finite()) {
        return None;
    }
    let largest = v[0].max(v[1]).max(v[2]);
    if largest == 0.0 {
        return None;
    }
    let small = [v[0] / largest, v[1] / largest, v[2] / largest];
    let length = (small[0] * small[0] + small[1] * small[1] + small[2] * small[2]).sqrt();
    Some([small[0] / length, small[1] / length, small[2] / length])
}
