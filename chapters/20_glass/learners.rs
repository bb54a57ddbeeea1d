//! Answers that readers of chapter 20 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "the part along the surface is divided by η as on the page, and for the root I remember 1 − η² sin² from another book, whose η is the other way round",
            exercise(a),
            "η is inverted",
        ),
        (
            "c is the cosine between direction and normal, so c = R·n (the minus forgotten)",
            exercise(b),
            "minus is missing",
        ),
        (
            "where nothing passes the light is reflected, so that is where it goes on: I return the mirror's direction",
            exercise(c),
            "mirror's direction",
        ),
        (
            "only the part along the surface is divided by η, and the other part is g along −n (mixes the two forms of the formula)",
            exercise(d),
            "whole sum",
        ),
        (
            "divide the part along the surface by η, leave the part along the normal, and normalise; only grazing light cannot pass",
            exercise(e),
            "normalised together",
        ),
        (
            "Snell's law divides the angle by η (not its sine), and above 90° nothing passes",
            exercise(f),
            "angle is divided",
        ),
        (
            "Snell: light bends toward the normal by the factor eta, so the refracted angle is the angle divided by eta.",
            exercise(second_a),
            "the angle is divided by η; Snell's",
        ),
        (
            "c is the cosine, so the dot product of direction and normal; I overlooked the minus in front of it.",
            exercise(second_b),
            "the minus is missing: the direction",
        ),
        (
            "I knew the root from another book, 1 − eta² (1 − c²), where eta is near over far, and took the rest from this page.",
            exercise(second_c),
            "under the root η is inverted: √(1 −",
        ),
    ]
}

fn right(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
    let c = -(direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
    let g2 = eta * eta - 1.0 + c * c;
    if g2 < 0.0 {
        return None;
    }
    let k = c - g2.sqrt();
    Some([
        (direction[0] + k * normal[0]) / eta,
        (direction[1] + k * normal[1]) / eta,
        (direction[2] + k * normal[2]) / eta,
    ])
}

fn a(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
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

fn b(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
    let c = direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2];
    let g2 = eta * eta - 1.0 + c * c;
    if g2 < 0.0 {
        return None;
    }
    let k = c - g2.sqrt();
    Some([
        (direction[0] + k * normal[0]) / eta,
        (direction[1] + k * normal[1]) / eta,
        (direction[2] + k * normal[2]) / eta,
    ])
}

fn c(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
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

fn d(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
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

fn e(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
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

fn f(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
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

fn second_a(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
    let c = -(direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
    let along = [direction[0] + c * normal[0], direction[1] + c * normal[1], direction[2] + c * normal[2]];
    let sine = (along[0] * along[0] + along[1] * along[1] + along[2] * along[2]).sqrt();
    if sine < 1e-12 {
        return Some(direction);
    }
    let refracted = sine.min(1.0).asin() / eta;
    if refracted > std::f64::consts::FRAC_PI_2 {
        return None;
    }
    let (s, k) = (refracted.sin(), refracted.cos());
    Some([
        along[0] / sine * s - k * normal[0],
        along[1] / sine * s - k * normal[1],
        along[2] / sine * s - k * normal[2],
    ])
}

fn second_b(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
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

fn second_c(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
    let c = -(direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
    let k = 1.0 - eta * eta * (1.0 - c * c);
    if k < 0.0 {
        return None;
    }
    let root = k.sqrt();
    Some([
        (direction[0] + c * normal[0]) / eta - root * normal[0],
        (direction[1] + c * normal[1]) / eta - root * normal[1],
        (direction[2] + c * normal[2]) / eta - root * normal[2],
    ])
}
