//! Answers that readers of chapter 02 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "the length is how far one walks along the three axes together, and sums of absolute values cannot overflow",
            exercise(a),
            "|x| + |y| + |z|",
        ),
        ("v·v is the length (I forgot that it is the length squared)", exercise(b), "square root is missing"),
        (
            "the page says to divide by the largest part, then the largest is 1, so that must be length 1",
            exercise(c),
            "makes that part 1",
        ),
        (
            "hypot never overflows, so hypot of hypot is safe for everything that the comment asks for",
            exercise(d),
            "length itself overflows",
        ),
        (
            "a vector is 0 if a part of it is 0, so I return None as soon as I find a 0",
            exercise(e),
            "one part that is 0",
        ),
        (
            "divide by the largest part first, then by the length; the largest part is the maximum of the three",
            exercise(f),
            "largest part is taken with its sign",
        ),
        (
            "'Divide by the largest part first; then the largest square is 1', so after that division the length is 1 and I am done.",
            exercise(second_a),
            "the vector is divided by its",
        ),
        (
            "I made the vector small by its largest part so that nothing overflows, and then divided by the length of v as the formula says, v being the one that I was given.",
            exercise(second_b),
            "the divided vector's own length",
        ),
        (
            "The largest part is the maximum of the three; I forgot that parts can be negative, so that the 'largest' may be 0 or turn the vector round.",
            exercise(second_c),
            "the largest part is taken with its",
        ),
    ]
}

fn right(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    if length > 0.0 && length.is_finite() { Some([v[0] / length, v[1] / length, v[2] / length]) } else { None }
}

fn a(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = v[0].abs() + v[1].abs() + v[2].abs();
    if length > 0.0 && length.is_finite() { Some([v[0] / length, v[1] / length, v[2] / length]) } else { None }
}

fn b(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if length == 0.0 || !length.is_finite() {
        return None;
    }
    Some(v.map(|part| part / length))
}

fn c(v: [f64; 3]) -> Option<[f64; 3]> {
    let largest = v[0].abs().max(v[1].abs()).max(v[2].abs());
    if v.iter().any(|part| !part.is_finite()) || largest == 0.0 {
        return None;
    }
    Some([v[0] / largest, v[1] / largest, v[2] / largest])
}

fn d(v: [f64; 3]) -> Option<[f64; 3]> {
    if !(v[0].is_finite() && v[1].is_finite() && v[2].is_finite()) {
        return None;
    }
    let length = v[0].hypot(v[1]).hypot(v[2]);
    if length == 0.0 {
        return None;
    }
    Some([v[0] / length, v[1] / length, v[2] / length])
}

fn e(v: [f64; 3]) -> Option<[f64; 3]> {
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

fn f(v: [f64; 3]) -> Option<[f64; 3]> {
    if v.iter().any(|part| !part.is_finite()) || v == [0.0; 3] {
        return None;
    }
    let largest = v[0].max(v[1]).max(v[2]);
    let s = [v[0] / largest, v[1] / largest, v[2] / largest];
    let length = (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]).sqrt();
    Some([s[0] / length, s[1] / length, s[2] / length])
}

fn second_a(v: [f64; 3]) -> Option<[f64; 3]> {
    if !v.iter().all(|part| part.is_finite()) {
        return None;
    }
    let largest = v[0].abs().max(v[1].abs()).max(v[2].abs());
    if largest == 0.0 {
        return None;
    }
    Some([v[0] / largest, v[1] / largest, v[2] / largest])
}

fn second_b(v: [f64; 3]) -> Option<[f64; 3]> {
    if !v.iter().all(|part| part.is_finite()) {
        return None;
    }
    let largest = v[0].abs().max(v[1].abs()).max(v[2].abs());
    if largest == 0.0 {
        return None;
    }
    let small = [v[0] / largest, v[1] / largest, v[2] / largest];
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    Some([small[0] / length, small[1] / length, small[2] / length])
}

fn second_c(v: [f64; 3]) -> Option<[f64; 3]> {
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
