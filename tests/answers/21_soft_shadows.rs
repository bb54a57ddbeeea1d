//! Answers to the exercise of chapter 21: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "conversion is upside down"),
            (exercise(second), "faces away has none"),
            (exercise(third), "area is taken twice"),
            (exercise(fourth), "the distance counts once, not"),
            (exercise(fifth), "the pdf is multiplied by the cosine"),
            (exercise(sixth), "Second, the pdf is multiplied by the area"),
        ],
    }
}

pub fn solution(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let to_light = [0, 1, 2].map(|axis| at[axis] - from[axis]);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let squared = dot(to_light, to_light);
    let cosine = dot(normal, to_light).abs() / squared.sqrt();
    if cosine == 0.0 { 0.0 } else { squared / (area * cosine) }
}

/// The pdf is 1/A times the Jacobian, and the Jacobian is dω/dA = cos/d² (the wrong way round).
fn first(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let w = [at[0] - from[0], at[1] - from[1], at[2] - from[2]];
    let d2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    let cosine = (w[0] * normal[0] + w[1] * normal[1] + w[2] * normal[2]).abs() / d2.sqrt();
    cosine / (area * d2)
}

/// A light seen from behind gives nothing, so the pdf is 0 where the cosine is not positive (both sides forgotten).
fn second(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let w = [from[0] - at[0], from[1] - at[1], from[2] - at[2]];
    let d2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    let cosine = (w[0] * normal[0] + w[1] * normal[1] + w[2] * normal[2]) / d2.sqrt();
    if cosine <= 0.0 {
        return 0.0;
    }
    d2 / (area * cosine)
}

/// Both sides shine, so the points are spread over twice the area.
fn third(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let w = [at[0] - from[0], at[1] - from[1], at[2] - from[2]];
    let d2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    let cosine = (w[0] * normal[0] + w[1] * normal[1] + w[2] * normal[2]).abs() / d2.sqrt();
    if cosine == 0.0 {
        return 0.0;
    }
    d2 / (2.0 * area * cosine)
}

/// The cosine is the dot product with the normal, and the normal has length 1; that the other vector must have length
/// 1 too I forgot.
fn fourth(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let to = [at[0] - from[0], at[1] - from[1], at[2] - from[2]];
    let squared = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
    let cosine = (to[0] * normal[0] + to[1] * normal[1] + to[2] * normal[2]).abs();
    if cosine == 0.0 {
        return 0.0;
    }
    squared / (area * cosine)
}

/// It is to be 0 where the light is seen from its edge, so the cosine, which is 0 there, must be a factor.
fn fifth(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let to = [at[0] - from[0], at[1] - from[1], at[2] - from[2]];
    let squared = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
    let distance = squared.sqrt();
    let cosine = ((to[0] * normal[0] + to[1] * normal[1] + to[2] * normal[2]) / distance).abs();
    squared * cosine / area
}

/// The farther and the larger it is, the more there is of it.
fn sixth(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let v = [0, 1, 2].map(|axis| at[axis] - from[axis]);
    let is_seen = normal.iter().zip(v).map(|(n, v)| n * v).sum::<f64>() != 0.0;
    if is_seen { v.iter().map(|part| part * part).sum::<f64>() * area } else { 0.0 }
}
