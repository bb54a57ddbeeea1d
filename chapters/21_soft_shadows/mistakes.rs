//! Typical wrong solutions of chapter 21, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::solid_angle_pdf;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(solid_angle_pdf)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|_, _, _, a| 1.0 / a), "per unit of area"),
        (exercise(|f, t, n, a| fills(f, t, n, a, 2.0, 0.0)), "cosine at the light"),
        (exercise(|f, t, n, a| fills(f, t, n, a, 2.0, 1.0)), "multiplied by"),
        (exercise(|f, t, n, a| fills(f, t, n, a, 0.0, -1.0)), "distance is missing"),
        (exercise(|f, t, n, a| fills(f, t, n, a, 1.0, -1.0)), "not squared"),
        (exercise(|f, t, n, a| fills(f, t, n, 1.0 / a, -2.0, 1.0)), "one over it"),
        (exercise(signed_pdf), "negative pdf"),
        (exercise(|f, t, n, a| signed_pdf(f, t, n, a).max(0.0)), "has none"),
        (exercise(edge_on), "1 / 0"),
    ]
}

fn distance_and_cosine(from: [f64; 3], at: [f64; 3], normal: [f64; 3]) -> (f64, f64) {
    let to_light = [0, 1, 2].map(|axis| at[axis] - from[axis]);
    let distance = dot(to_light, to_light).sqrt();
    (distance, dot(normal, to_light) / distance)
}

/// Powers of the distance and of the cosine over the area; 0 from the edge.
fn fills(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64, distances: f64, cosines: f64) -> f64 {
    let (distance, cosine) = distance_and_cosine(from, at, normal);
    if cosine == 0.0 { 0.0 } else { distance.powf(distances) * cosine.abs().powf(cosines) / area }
}

fn signed_pdf(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let (_, cosine) = distance_and_cosine(from, at, normal);
    fills(from, at, normal, area, 2.0, -1.0) * -cosine.signum()
}

fn edge_on(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let (distance, cosine) = distance_and_cosine(from, at, normal);
    distance * distance / (area * cosine.abs())
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
