//! Answers to the exercise of chapter 20: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "η is inverted"),
            (exercise(second), "mirror's direction"),
            (exercise(third), "whole sum"),
            (exercise(fourth), "normalised together"),
            (exercise(fifth), "angle is divided"),
            (exercise(sixth), "the minus is missing: the direction"),
        ],
    }
}

pub fn solution(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
    let cosine = -(direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
    let squared = (eta - 1.0) * (eta + 1.0) + cosine * cosine;
    if squared < 0.0 {
        return None;
    }
    let along = cosine - squared.sqrt();
    Some([0, 1, 2].map(|part| (direction[part] + along * normal[part]) / eta))
}

/// The part along the surface is divided by η as on the page, and for the root I remember 1 − η² sin² from another
/// book, whose η is the other way round.
fn first(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
    let c = -(direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
    let cos2 = 1.0 - eta * eta * (1.0 - c * c);
    if cos2 < 0.0 {
        return None;
    }
    let root = cos2.sqrt();
    Some([
        (direction[0] + c * normal[0]) / eta - root * normal[0],
        (direction[1] + c * normal[1]) / eta - root * normal[1],
        (direction[2] + c * normal[2]) / eta - root * normal[2],
    ])
}

/// Where nothing passes the light is reflected, so that is where it goes on: I return the mirror's direction.
fn second(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
    let c = -(direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
    let g2 = eta * eta - 1.0 + c * c;
    if g2 < 0.0 {
        return Some([
            direction[0] + 2.0 * c * normal[0],
            direction[1] + 2.0 * c * normal[1],
            direction[2] + 2.0 * c * normal[2],
        ]);
    }
    let k = c - g2.sqrt();
    Some([
        (direction[0] + k * normal[0]) / eta,
        (direction[1] + k * normal[1]) / eta,
        (direction[2] + k * normal[2]) / eta,
    ])
}

/// Only the part along the surface is divided by η, and the other part is g along −n (mixes the two forms of the
/// formula).
fn third(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
    let c = -(direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
    let g2 = eta * eta - 1.0 + c * c;
    if g2 < 0.0 {
        return None;
    }
    let g = g2.sqrt();
    Some([
        (direction[0] + c * normal[0]) / eta - g * normal[0],
        (direction[1] + c * normal[1]) / eta - g * normal[1],
        (direction[2] + c * normal[2]) / eta - g * normal[2],
    ])
}

/// Divide the part along the surface by η, leave the part along the normal, and normalise; only grazing light cannot
/// pass.
fn fourth(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
    let c = -(direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
    if c <= 0.0 {
        return None;
    }
    let t = [
        (direction[0] + c * normal[0]) / eta - c * normal[0],
        (direction[1] + c * normal[1]) / eta - c * normal[1],
        (direction[2] + c * normal[2]) / eta - c * normal[2],
    ];
    let l = (t[0] * t[0] + t[1] * t[1] + t[2] * t[2]).sqrt();
    Some([t[0] / l, t[1] / l, t[2] / l])
}

/// Snell's law divides the angle by η (not its sine), and above 90° nothing passes.
fn fifth(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
    let c = -(direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
    let angle = c.clamp(-1.0, 1.0).acos() / eta;
    if angle > std::f64::consts::FRAC_PI_2 {
        return None;
    }
    let along = [direction[0] + c * normal[0], direction[1] + c * normal[1], direction[2] + c * normal[2]];
    let l = (along[0] * along[0] + along[1] * along[1] + along[2] * along[2]).sqrt();
    if l < 1e-12 {
        return Some(direction);
    }
    let (s, k) = (angle.sin() / l, angle.cos());
    Some([s * along[0] - k * normal[0], s * along[1] - k * normal[1], s * along[2] - k * normal[2]])
}

/// C is the cosine, so the dot product of direction and normal; I overlooked the minus in front of it.
fn sixth(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
    let c = direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2];
    let g_squared = eta * eta - 1.0 + c * c;
    if g_squared < 0.0 {
        return None;
    }
    let g = g_squared.sqrt();
    Some([
        (direction[0] + (c - g) * normal[0]) / eta,
        (direction[1] + (c - g) * normal[1]) / eta,
        (direction[2] + (c - g) * normal[2]) / eta,
    ])
}
