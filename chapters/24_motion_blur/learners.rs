//! Answers that readers of chapter 24 gave who saw its page and nothing else, and words of the remark that each must get.

use super::question::exercise;
use pinhole_lab::exercise::Exercise;

/// The formula straight from the page.
pub fn textbook() -> Exercise {
    exercise(right)
}

/// What each reader thought, and the answer.
pub fn all() -> Vec<(&'static str, Exercise, &'static str)> {
    vec![
        ("the sphere moves forward by vτ, so the ray's origin moves forward too", exercise(a), "moves backwards"),
        (
            "seen from the sphere the ray also has another direction, R − v, as velocities are subtracted",
            exercise(b),
            "direction is changed",
        ),
        (
            "the smaller root is the nearer hit, whenever there is a root at all (t below 0 not excluded)",
            exercise(c),
            "behind the ray's origin",
        ),
        ("the solution of a quadratic is −b plus the root (the farther one)", exercise(d), "leaves the sphere"),
        (
            "the sphere is hit later by the time, so I intersect it at rest and only move the result: t plus v·R times the time",
            exercise(e),
            "only t is moved",
        ),
        (
            "with b = o·R (half of the real b) I use the school formula (−b − √(b² − 4c))/2",
            exercise(f),
            "forms of the quadratic",
        ),
        (
            "Seen from the sphere the ray moves the other way, so I subtracted the velocity from the ray's direction as well as v·time from its origin.",
            exercise(second_a),
            "the direction is changed by the",
        ),
        (
            "The sphere has moved on by v·time, and the ray has to be moved by −v·time; I did both.",
            exercise(second_b),
            "the motion counts twice: move",
        ),
        (
            "I intersect the sphere where it was at first; by the time it has moved on, the hit has moved along the ray by the velocity's part along the ray.",
            exercise(second_c),
            "the sphere stands still until it is",
        ),
    ]
}

fn right(
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
    let discriminant = b * b - c;
    if discriminant < 0.0 {
        return None;
    }
    let t = -b - discriminant.sqrt();
    if t > 0.0 { Some(t) } else { None }
}

fn a(
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

fn b(
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
    let a = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    let b = o[0] * d[0] + o[1] * d[1] + o[2] * d[2];
    let c = o[0] * o[0] + o[1] * o[1] + o[2] * o[2] - radius * radius;
    let discriminant = b * b - a * c;
    if discriminant < 0.0 {
        return None;
    }
    let t = (-b - discriminant.sqrt()) / a;
    if t > 0.0 { Some(t) } else { None }
}

fn c(
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

fn d(
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
    let discriminant = b * b - c;
    if discriminant < 0.0 {
        return None;
    }
    let t = -b + discriminant.sqrt();
    if t > 0.0 { Some(t) } else { None }
}

fn e(
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

fn f(
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

fn second_a(
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

fn second_b(
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

fn second_c(
    origin: [f64; 3],
    direction: [f64; 3],
    centre: [f64; 3],
    radius: f64,
    velocity: [f64; 3],
    time: f64,
) -> Option<f64> {
    let o = [origin[0] - centre[0], origin[1] - centre[1], origin[2] - centre[2]];
    let qb = o[0] * direction[0] + o[1] * direction[1] + o[2] * direction[2];
    let qc = o[0] * o[0] + o[1] * o[1] + o[2] * o[2] - radius * radius;
    let discriminant = qb * qb - qc;
    if discriminant < 0.0 {
        return None;
    }
    let along = velocity[0] * direction[0] + velocity[1] * direction[1] + velocity[2] * direction[2];
    let t = -qb - discriminant.sqrt() + along * time;
    if t > 0.0 { Some(t) } else { None }
}
