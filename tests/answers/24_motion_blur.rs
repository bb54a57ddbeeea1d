//! Answers to the exercise of chapter 24: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "moves backwards"),
            (exercise(second), "behind the ray's origin"),
            (exercise(third), "only t is moved"),
            (exercise(fourth), "forms of the quadratic"),
            (exercise(fifth), "the direction is changed by the"),
            (exercise(sixth), "the motion counts twice: move"),
        ],
    }
}

pub fn solution(
    origin: [f64; 3],
    direction: [f64; 3],
    centre: [f64; 3],
    radius: f64,
    velocity: [f64; 3],
    time: f64,
) -> Option<f64> {
    let moved = [0, 1, 2].map(|axis| centre[axis] + velocity[axis] * time);
    nearest_sphere_t(origin, direction, moved, radius)
}

/// The nearest t above 0 of a sphere that stands still, as in chapter 03.
pub fn nearest_sphere_t(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let f = [centre[0] - origin[0], centre[1] - origin[1], centre[2] - origin[2]];
    let dd = dot(direction, direction);
    let s = dot(f, direction) / dd;
    let across = [f[0] - s * direction[0], f[1] - s * direction[1], f[2] - s * direction[2]];
    let discriminant = radius * radius - dot(across, across);
    let c = dot(f, f) - radius * radius;
    if discriminant < 0.0 || (c >= 0.0 && s <= 0.0) {
        return None;
    }
    let h = (discriminant / dd).sqrt();
    Some(match (c > 0.0, s >= 0.0) {
        (true, _) => c / (dd * (s + h)),
        (false, true) => s + h,
        (false, false) => c / (dd * (s - h)),
    })
}

/// The sphere moves forward by vτ, so the ray's origin moves forward too.
fn first(
    origin: [f64; 3],
    direction: [f64; 3],
    centre: [f64; 3],
    radius: f64,
    velocity: [f64; 3],
    time: f64,
) -> Option<f64> {
    let o = [
        origin[0] + velocity[0] * time - centre[0],
        origin[1] + velocity[1] * time - centre[1],
        origin[2] + velocity[2] * time - centre[2],
    ];
    let b = o[0] * direction[0] + o[1] * direction[1] + o[2] * direction[2];
    let c = o[0] * o[0] + o[1] * o[1] + o[2] * o[2] - radius * radius;
    let discriminant = b * b - c;
    if discriminant < 0.0 {
        return None;
    }
    let t = -b - discriminant.sqrt();
    if t > 0.0 { Some(t) } else { None }
}

/// The smaller root is the nearer hit, whenever there is a root at all (t below 0 not excluded).
fn second(
    origin: [f64; 3],
    direction: [f64; 3],
    centre: [f64; 3],
    radius: f64,
    velocity: [f64; 3],
    time: f64,
) -> Option<f64> {
    let m = [
        centre[0] + velocity[0] * time - origin[0],
        centre[1] + velocity[1] * time - origin[1],
        centre[2] + velocity[2] * time - origin[2],
    ];
    let b = m[0] * direction[0] + m[1] * direction[1] + m[2] * direction[2];
    let discriminant = b * b - (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]) + radius * radius;
    if discriminant < 0.0 { None } else { Some(b - discriminant.sqrt()) }
}

/// The sphere is hit later by the time, so I intersect it at rest and only move the result: t plus v·R times the time.
fn third(
    origin: [f64; 3],
    direction: [f64; 3],
    centre: [f64; 3],
    radius: f64,
    velocity: [f64; 3],
    time: f64,
) -> Option<f64> {
    let o = [origin[0] - centre[0], origin[1] - centre[1], origin[2] - centre[2]];
    let b = o[0] * direction[0] + o[1] * direction[1] + o[2] * direction[2];
    let c = o[0] * o[0] + o[1] * o[1] + o[2] * o[2] - radius * radius;
    let discriminant = b * b - c;
    if discriminant < 0.0 {
        return None;
    }
    let along = velocity[0] * direction[0] + velocity[1] * direction[1] + velocity[2] * direction[2];
    let t = -b - discriminant.sqrt() + along * time;
    if t > 0.0 { Some(t) } else { None }
}

/// With b = o·R (half of the real b) I use the school formula (−b − √(b² − 4c))/2.
fn fourth(
    origin: [f64; 3],
    direction: [f64; 3],
    centre: [f64; 3],
    radius: f64,
    velocity: [f64; 3],
    time: f64,
) -> Option<f64> {
    let o = [
        origin[0] - velocity[0] * time - centre[0],
        origin[1] - velocity[1] * time - centre[1],
        origin[2] - velocity[2] * time - centre[2],
    ];
    let b = o[0] * direction[0] + o[1] * direction[1] + o[2] * direction[2];
    let c = o[0] * o[0] + o[1] * o[1] + o[2] * o[2] - radius * radius;
    let discriminant = b * b - 4.0 * c;
    if discriminant < 0.0 {
        return None;
    }
    let t = (-b - discriminant.sqrt()) / 2.0;
    if t > 0.0 { Some(t) } else { None }
}

/// Seen from the sphere the ray moves the other way, so I subtracted the velocity from the ray's direction as well as
/// v·time from its origin.
fn fifth(
    origin: [f64; 3],
    direction: [f64; 3],
    centre: [f64; 3],
    radius: f64,
    velocity: [f64; 3],
    time: f64,
) -> Option<f64> {
    let o = [
        origin[0] - velocity[0] * time - centre[0],
        origin[1] - velocity[1] * time - centre[1],
        origin[2] - velocity[2] * time - centre[2],
    ];
    let d = [direction[0] - velocity[0], direction[1] - velocity[1], direction[2] - velocity[2]];
    let qa = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    let qb = o[0] * d[0] + o[1] * d[1] + o[2] * d[2];
    let qc = o[0] * o[0] + o[1] * o[1] + o[2] * o[2] - radius * radius;
    let discriminant = qb * qb - qa * qc;
    if discriminant < 0.0 || qa == 0.0 {
        return None;
    }
    let t = (-qb - discriminant.sqrt()) / qa;
    if t > 0.0 { Some(t) } else { None }
}

/// The sphere has moved on by v·time, and the ray has to be moved by −v·time; I did both.
fn sixth(
    origin: [f64; 3],
    direction: [f64; 3],
    centre: [f64; 3],
    radius: f64,
    velocity: [f64; 3],
    time: f64,
) -> Option<f64> {
    let mut to_origin = [0.0; 3];
    for i in 0..3 {
        let start = origin[i] - velocity[i] * time;
        let middle = centre[i] + velocity[i] * time;
        to_origin[i] = start - middle;
    }
    let qb = to_origin[0] * direction[0] + to_origin[1] * direction[1] + to_origin[2] * direction[2];
    let qc = to_origin[0] * to_origin[0] + to_origin[1] * to_origin[1] + to_origin[2] * to_origin[2] - radius * radius;
    let discriminant = qb * qb - qc;
    if discriminant < 0.0 {
        return None;
    }
    let t = -qb - discriminant.sqrt();
    if t > 0.0 { Some(t) } else { None }
}
