//! Typical wrong solutions of chapter 27, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::pixel_fraction;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(pixel_fraction)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|point, t, h| shared(point, 2.0 * t / h, 2, 4)), "cos⁴ is taken"),
        (exercise(|point, t, h| shared(point, 2.0 * t / h, 2, 1)), "cos is taken"),
        (exercise(|point, t, h| shared(point, 2.0 * t / h, 2, 0)), "cos³ θ is missing"),
        (exercise(|point, t, h| shared(point, 2.0 * t / h, 1, 3)), "its side squared"),
        (exercise(|point, t, h| shared(point, 2.0 * t / h, 0, 3)), "area A is missing"),
        (exercise(|point, t, h| shared(point, t / h, 2, 3)), "not tan_half"),
        (
            exercise(|[x, y, z], t, h| {
                let side = 2.0 * t / h;
                (x * x + y * y + z * z).sqrt() / (side * side * -z * z * z)
            }),
            "behind the eye",
        ),
        (exercise(|point, t, h| dot(point, point) * shared(point, 2.0 * t / h, 2, 3)), "1/d² is missing"),
    ]
}

/// 1 over powers of a pixel's side and of the cosine off the axis, and over the square of the distance.
fn shared(point: [f64; 3], side: f64, sides: i32, cosines: i32) -> f64 {
    let distance = dot(point, point).sqrt();
    let cosine = -point[2] / distance;
    if cosine > 0.0 { 1.0 / (side.powi(sides) * distance * distance * cosine.powi(cosines)) } else { 0.0 }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
