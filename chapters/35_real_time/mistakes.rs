//! Typical wrong solutions of chapter 35, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::edge_weight;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(edge_weight)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(facing_away), "face away"),
        (exercise(by_distance), "scene's units"),
        (exercise(|normal, neighbour, offset| edge_weight(neighbour, normal, offset)), "neighbour's plane"),
        (exercise(|normal, neighbour, _| edge_weight(normal, neighbour, [0.0; 3])), "only the normals"),
        (exercise(|normal, _, offset| edge_weight(normal, normal, offset)), "only the plane"),
        (exercise(without_square), "square"),
        (exercise(cosine_alone), "32nd power"),
        (exercise(along_the_normal), "along the plane"),
        (exercise(divided_by_nothing), "length 0"),
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn sine(normal: [f64; 3], offset: [f64; 3]) -> f64 {
    let length = dot(offset, offset).sqrt();
    if length > 0.0 { dot(normal, offset) / length } else { 0.0 }
}

fn facing_away(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let sine = sine(normal, offset);
    dot(normal, neighbour).powi(32) * 0.01 / (0.01 + sine * sine)
}

fn by_distance(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let off = dot(normal, offset);
    edge_weight(normal, neighbour, [0.0; 3]) * 0.01 / (0.01 + off * off)
}

fn without_square(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    edge_weight(normal, neighbour, [0.0; 3]) * 0.01 / (0.01 + sine(normal, offset).abs())
}

fn cosine_alone(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    dot(normal, neighbour).max(0.0) * edge_weight(normal, normal, offset)
}

fn along_the_normal(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let sine = sine(normal, offset);
    edge_weight(normal, neighbour, [0.0; 3]) * 0.01 / (0.01 + (1.0 - sine * sine))
}

fn divided_by_nothing(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let sine = dot(normal, offset) / dot(offset, offset).sqrt();
    edge_weight(normal, neighbour, [0.0; 3]) * 0.01 / (0.01 + sine * sine)
}
