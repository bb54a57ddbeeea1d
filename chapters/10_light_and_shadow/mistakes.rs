//! Typical wrong solutions of chapter 10, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::reflected_radiance;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(reflected_radiance)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|c, i, p, n, l| light(c, i, p, n, l, |x| x, 2)), "negative"),
        (exercise(|c, i, p, n, l| light(c, i, p, n, l, f64::abs, 2)), "from behind"),
        (exercise(|c, i, p, n, l| light(c, i, p, n, l, |x| x.max(0.0), 1)), "square"),
        (exercise(without_pi), "π is missing"),
        (exercise(not_a_number), "no number"),
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

fn divided(v: [f64; 3], by: f64) -> [f64; 3] {
    v.map(|part| part / by)
}

fn normalised(v: [f64; 3]) -> [f64; 3] {
    divided(v, length(v))
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn light(
    colour: f64,
    intensity: f64,
    position: [f64; 3],
    normal: [f64; 3],
    light: [f64; 3],
    cosine: fn(f64) -> f64,
    power: i32,
) -> f64 {
    let to_light = minus(light, position);
    let cosine_of_light = dot(normal, normalised(to_light));
    if cosine_of_light.is_nan() {
        return 0.0;
    }
    colour / std::f64::consts::PI * intensity * cosine(cosine_of_light) / length(to_light).powi(power)
}

fn without_pi(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], at: [f64; 3]) -> f64 {
    light(colour, intensity, position, normal, at, |cosine| cosine.max(0.0), 2) * std::f64::consts::PI
}

fn not_a_number(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], at: [f64; 3]) -> f64 {
    if position == at { f64::NAN } else { light(colour, intensity, position, normal, at, |x| x.max(0.0), 2) }
}
