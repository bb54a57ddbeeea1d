//! Typical wrong solutions of chapter 03, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::nearest_sphere_t;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(nearest_sphere_t)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|o, d, c, r| school(o, d, c, r).map(|(near, _)| near)), "behind the origin"),
        (exercise(|o, d, c, r| Some(school(o, d, c, r)?.0).filter(|&t| t > 0.0)), "from inside"),
        (exercise(|o, d, c, r| Some(school(o, d, c, r)?.1).filter(|&t| t > 0.0)), "farther root"),
        (exercise(both_roots), "b² − ac (or b² − 4ac)"),
        (exercise(unit_assumed), "length 1"),
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The quadratic formula of school.
fn school(o: [f64; 3], d: [f64; 3], centre: [f64; 3], radius: f64) -> Option<(f64, f64)> {
    let f = minus(o, centre);
    let (a, b, c) = (dot(d, d), 2.0 * dot(f, d), dot(f, f) - radius * radius);
    let discriminant = b * b - 4.0 * a * c;
    let root = (discriminant >= 0.0).then(|| discriminant.sqrt())?;
    Some(((-b - root) / (2.0 * a), (-b + root) / (2.0 * a)))
}

fn both_roots(o: [f64; 3], d: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    let (near, far) = school(o, d, centre, radius)?;
    [near, far].into_iter().find(|&t| t > 0.0)
}

fn unit_assumed(o: [f64; 3], d: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    let f = minus(centre, o);
    let s = dot(f, d);
    let across = minus(f, d.map(|part| part * s));
    let h = radius * radius - dot(across, across);
    let h = (h >= 0.0).then(|| h.sqrt())?;
    [s - h, s + h].into_iter().find(|&t| t > 0.0)
}
