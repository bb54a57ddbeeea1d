//! Answers that readers of chapter 21 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "the cosine is the dot product of the normal and the vector between the points (never normalised)",
            exercise(a),
            "counts once, not squared",
        ),
        (
            "the pdf is 1/A times the Jacobian, and the Jacobian is dω/dA = cos/d² (the wrong way round)",
            exercise(b),
            "conversion is upside down",
        ),
        (
            "a light seen from behind gives nothing, so the pdf is 0 where the cosine is not positive (both sides forgotten)",
            exercise(c),
            "faces away has none",
        ),
        (
            "an oblique light counts less, so its pdf is multiplied by the cosine, and that also makes it 0 at the edge",
            exercise(d),
            "multiplied by the cosine",
        ),
        ("d²/(A cos) and no more: at the edge the division gives what it gives", exercise(e), "not 1 / 0"),
        ("both sides shine, so the points are spread over twice the area", exercise(f), "area is taken twice"),
        (
            "The cosine is the dot product with the normal, and the normal has length 1; that the other vector must have length 1 too I forgot.",
            exercise(second_a),
            "the distance counts once, not",
        ),
        (
            "It is to be 0 where the light is seen from its edge, so the cosine, which is 0 there, must be a factor.",
            exercise(second_b),
            "the pdf is multiplied by the cosine",
        ),
        (
            "Both of the light's sides shine, so the point is chosen from twice the area.",
            exercise(second_c),
            "the area is taken twice; though",
        ),
    ]
}

fn right(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let w = [from[0] - at[0], from[1] - at[1], from[2] - at[2]];
    let d2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    let cosine = (w[0] * normal[0] + w[1] * normal[1] + w[2] * normal[2]).abs() / d2.sqrt();
    if cosine == 0.0 {
        return 0.0;
    }
    d2 / (area * cosine)
}

fn a(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let w = [from[0] - at[0], from[1] - at[1], from[2] - at[2]];
    let d2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    let cosine = (w[0] * normal[0] + w[1] * normal[1] + w[2] * normal[2]).abs();
    if cosine == 0.0 {
        return 0.0;
    }
    d2 / (area * cosine)
}

fn b(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let w = [at[0] - from[0], at[1] - from[1], at[2] - from[2]];
    let d2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    let cosine = (w[0] * normal[0] + w[1] * normal[1] + w[2] * normal[2]).abs() / d2.sqrt();
    cosine / (area * d2)
}

fn c(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let w = [from[0] - at[0], from[1] - at[1], from[2] - at[2]];
    let d2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    let cosine = (w[0] * normal[0] + w[1] * normal[1] + w[2] * normal[2]) / d2.sqrt();
    if cosine <= 0.0 {
        return 0.0;
    }
    d2 / (area * cosine)
}

fn d(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let w = [from[0] - at[0], from[1] - at[1], from[2] - at[2]];
    let d2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    let cosine = (w[0] * normal[0] + w[1] * normal[1] + w[2] * normal[2]).abs() / d2.sqrt();
    d2 * cosine / area
}

fn e(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let w = [at[0] - from[0], at[1] - from[1], at[2] - from[2]];
    let d2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    let cosine = (w[0] * normal[0] + w[1] * normal[1] + w[2] * normal[2]).abs() / d2.sqrt();
    d2 / (area * cosine)
}

fn f(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let w = [at[0] - from[0], at[1] - from[1], at[2] - from[2]];
    let d2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    let cosine = (w[0] * normal[0] + w[1] * normal[1] + w[2] * normal[2]).abs() / d2.sqrt();
    if cosine == 0.0 {
        return 0.0;
    }
    d2 / (2.0 * area * cosine)
}

fn second_a(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let to = [at[0] - from[0], at[1] - from[1], at[2] - from[2]];
    let squared = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
    let cosine = (to[0] * normal[0] + to[1] * normal[1] + to[2] * normal[2]).abs();
    if cosine == 0.0 {
        return 0.0;
    }
    squared / (area * cosine)
}

fn second_b(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let to = [at[0] - from[0], at[1] - from[1], at[2] - from[2]];
    let squared = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
    let distance = squared.sqrt();
    let cosine = ((to[0] * normal[0] + to[1] * normal[1] + to[2] * normal[2]) / distance).abs();
    squared * cosine / area
}

fn second_c(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let to = [at[0] - from[0], at[1] - from[1], at[2] - from[2]];
    let squared = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
    let cosine = ((to[0] * normal[0] + to[1] * normal[1] + to[2] * normal[2]) / squared.sqrt()).abs();
    if cosine == 0.0 {
        return 0.0;
    }
    squared / (2.0 * area * cosine)
}
