//! Typical wrong solutions of chapter 15, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::phong_radiance;
use pinhole_lab::exercise::Exercise;
use std::f64::consts::PI;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(phong_radiance)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|m, e, n, l, v| phong(m, e, n, l, v, 2.0, dot(n, l))), "faces away"),
        (exercise(|m, e, n, l, v| phong(m, e, n, l, v, 1.0, lit(n, l))), "n + 2"),
        (exercise(|m, e, n, l, v| phong(m, e, n, l, v, 2.0, step(n, l))), "cosine of the light's angle"),
        (exercise(even_behind), "even"),
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Chapter 15 as it should be, but for the number beside n in the factor and for what arrives.
fn phong(m: [f64; 3], e: f64, n: [f64; 3], l: [f64; 3], v: [f64; 3], beside: f64, arrives: f64) -> f64 {
    let alpha = 2.0 * dot(n, l) * dot(n, v) - dot(l, v);
    let lobe = if alpha > 0.0 { (m[2] + beside) / (2.0 * PI) * alpha.min(1.0).powf(m[2]) } else { 0.0 };
    (m[0] / PI + m[1] * lobe) * e * arrives
}

fn lit(n: [f64; 3], l: [f64; 3]) -> f64 {
    dot(n, l).max(0.0)
}

fn step(n: [f64; 3], l: [f64; 3]) -> f64 {
    if dot(n, l) > 0.0 { 1.0 } else { 0.0 }
}

fn even_behind(m: [f64; 3], e: f64, n: [f64; 3], l: [f64; 3], v: [f64; 3]) -> f64 {
    let alpha = 2.0 * dot(n, l) * dot(n, v) - dot(l, v);
    let lobe = (m[2] + 2.0) / (2.0 * PI) * alpha.abs().min(1.0).powf(m[2]);
    (m[0] / PI + m[1] * lobe) * e * lit(n, l)
}
