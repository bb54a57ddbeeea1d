//! Typical wrong solutions of chapter 14, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::falling_cosine;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(falling_cosine)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|g, _, _, e, l| (side(g, e) * cosine(g, l)).max(0.0)), "as the surface lies"),
        (exercise(|g, n, s, e, l| fallen(g, cosine(turned(g, mixed(n, s), e), l), e, l)), "negative"),
        (exercise(|g, n, s, e, l| fallen(g, cosine(mixed(n, s), l), e, l).max(0.0)), "eye's side"),
        (exercise(not_unit), "length 1"),
        (exercise(below_too), "from below the surface"),
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

fn mixed(normals: [[f64; 3]; 3], weights: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| (0..3).map(|corner| weights[corner] * normals[corner][axis]).sum())
}

fn cosine(a: [f64; 3], b: [f64; 3]) -> f64 {
    dot(a, b) / length(a) / length(b)
}

fn side(normal: [f64; 3], towards: [f64; 3]) -> f64 {
    if dot(normal, towards) > 0.0 { 1.0 } else { -1.0 }
}

/// The mixed normal on the eye's side of the surface.
fn turned(geometric: [f64; 3], mixed: [f64; 3], eye: [f64; 3]) -> [f64; 3] {
    mixed.map(|part| part * side(geometric, eye) * side(geometric, mixed))
}

/// The cosine, and 0 where the light is below the surface.
fn fallen(geometric: [f64; 3], cosine: f64, eye: [f64; 3], light: [f64; 3]) -> f64 {
    if side(geometric, eye) == side(geometric, light) { cosine } else { 0.0 }
}

fn not_unit(g: [f64; 3], n: [[f64; 3]; 3], s: [f64; 3], e: [f64; 3], l: [f64; 3]) -> f64 {
    let normal = turned(g, mixed(n, s), e);
    fallen(g, dot(normal, l) / length(l), e, l).max(0.0)
}

fn below_too(g: [f64; 3], n: [[f64; 3]; 3], s: [f64; 3], e: [f64; 3], l: [f64; 3]) -> f64 {
    cosine(turned(g, mixed(n, s), e), l).max(0.0)
}
