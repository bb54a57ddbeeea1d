//! Typical wrong solutions of chapter 34, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::sphere_interval;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(sphere_interval)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|right, ahead, r, half| cut([(right - r) / ahead, (right + r) / ahead], half)), "at the depth of"),
        (
            exercise(|right, ahead, r, half| {
                let near = (ahead - r).max(1e-9);
                cut([(right - r) / near, (right + r) / near], half)
            }),
            "a box around the sphere",
        ),
        (exercise(|right, ahead, r, half| touching(right, ahead, r, |end| end.clamp(-half, half))), "not in front"),
        (exercise(|right, ahead, r, half| within(right, ahead, r, half, libm::atan)), "the sine"),
        (exercise(|right, ahead, r, edge| sphere_interval(-right, ahead, r, edge)), "to the right is positive"),
        (exercise(|right, ahead, r, _| sphere_interval(right, ahead, r, 1e9)), "cut off"),
        (
            exercise(|right, ahead, r, half| {
                let beside = r / (ahead * ahead - r * r).max(1e-12).sqrt();
                cut([right / ahead - beside, right / ahead + beside], half)
            }),
            "as if it were straight ahead",
        ),
    ]
}

fn cut(ends: [f64; 2], half: f64) -> [f64; 2] {
    ends.map(|end| end.clamp(-half, half))
}

/// Both tangents divided by how far in front they go, whatever its sign.
fn touching(right: f64, ahead: f64, r: f64, cut: impl Fn(f64) -> f64) -> [f64; 2] {
    let tangent = (right * right + ahead * ahead - r * r).max(0.0).sqrt();
    [-1.0, 1.0].map(|side| cut((right * tangent + side * ahead * r) / (ahead * tangent - side * right * r)))
}

/// By angles, of which the half is some function of radius over distance.
fn within(right: f64, ahead: f64, r: f64, half: f64, half_angle: fn(f64) -> f64) -> [f64; 2] {
    let (to_centre, distance) = (libm::atan2(right, ahead), libm::hypot(right, ahead));
    let reaches = if distance > r { half_angle(r / distance) } else { std::f64::consts::PI };
    [-1.0, 1.0].map(|side| match to_centre + side * reaches {
        angle if angle <= -libm::atan(half) => -half,
        angle if angle >= libm::atan(half) => half,
        angle => libm::tan(angle),
    })
}
