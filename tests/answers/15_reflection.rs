//! Answers to the exercise of chapter 15: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;
use std::f64::consts::PI;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: Some(exercise(textbook)),
        wrong: [
            (exercise(first), "about the half vector"),
            (exercise(second), "(n + 1) / 2π"),
            (exercise(third), "more than 90° from the mirrored light"),
            (exercise(fourth), "normalising does not replace it"),
            (exercise(fifth), "one part is lessened by what the"),
            (exercise(sixth), "Second, the factor (n + 2) / 2π"),
        ],
    }
}

pub fn solution(
    [colour, specular, exponent]: [f64; 3],
    irradiance: f64,
    normal: [f64; 3],
    to_light: [f64; 3],
    to_eye: [f64; 3],
) -> f64 {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cosine = dot(normal, to_light);
    if cosine <= 0.0 {
        return 0.0;
    }
    let alpha = 2.0 * cosine * dot(normal, to_eye) - dot(to_light, to_eye);
    let lobe = if alpha > 0.0 { (exponent + 2.0) / (2.0 * PI) * alpha.min(1.0).powf(exponent) } else { 0.0 };
    (colour / PI + specular * lobe) * irradiance * cosine
}

/// The formula straight from the page.
fn textbook(
    [colour, specular, exponent]: [f64; 3],
    irradiance: f64,
    normal: [f64; 3],
    to_light: [f64; 3],
    to_eye: [f64; 3],
) -> f64 {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let pi = std::f64::consts::PI;
    let cosine = dot(normal, to_light);
    if cosine <= 0.0 {
        return 0.0;
    }
    let mut mirror = [0.0f64; 3];
    for i in 0..3 {
        mirror[i] = 2.0 * cosine * normal[i] - to_light[i];
    }
    let alpha = dot(mirror, to_eye).max(0.0);
    let lobe = (exponent + 2.0) / (2.0 * pi) * alpha.powf(exponent);
    irradiance * cosine * (colour / pi + specular * lobe)
}

/// The highlight is the cosine between the normal and the half vector, to the power n, with the factor (n + 2)/2π.
fn first(
    [colour, specular, exponent]: [f64; 3],
    irradiance: f64,
    normal: [f64; 3],
    to_light: [f64; 3],
    to_eye: [f64; 3],
) -> f64 {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let pi = std::f64::consts::PI;
    let cosine = dot(normal, to_light);
    if cosine <= 0.0 {
        return 0.0;
    }
    let half = [to_light[0] + to_eye[0], to_light[1] + to_eye[1], to_light[2] + to_eye[2]];
    let beta = (dot(normal, half) / dot(half, half).sqrt()).max(0.0);
    let lobe = (exponent + 2.0) / (2.0 * pi) * beta.powf(exponent);
    irradiance * cosine * (colour / pi + specular * lobe)
}

/// The lobe cosⁿ over the hemisphere integrates to 2π/(n + 1), so the factor is (n + 1)/2π.
fn second(
    [colour, specular, exponent]: [f64; 3],
    irradiance: f64,
    normal: [f64; 3],
    to_light: [f64; 3],
    to_eye: [f64; 3],
) -> f64 {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let pi = std::f64::consts::PI;
    let cosine = dot(normal, to_light);
    if cosine <= 0.0 {
        return 0.0;
    }
    let mut mirror = [0.0f64; 3];
    for i in 0..3 {
        mirror[i] = 2.0 * cosine * normal[i] - to_light[i];
    }
    let alpha = dot(mirror, to_eye).max(0.0);
    let lobe = (exponent + 1.0) / (2.0 * pi) * alpha.powf(exponent);
    irradiance * cosine * (colour / pi + specular * lobe)
}

/// The eye is on the normal's side, so the cosine with the mirror direction cannot be negative and needs no test.
fn third(
    [colour, specular, exponent]: [f64; 3],
    irradiance: f64,
    normal: [f64; 3],
    to_light: [f64; 3],
    to_eye: [f64; 3],
) -> f64 {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let pi = std::f64::consts::PI;
    let cosine = dot(normal, to_light);
    if cosine <= 0.0 {
        return 0.0;
    }
    let mut mirror = [0.0f64; 3];
    for i in 0..3 {
        mirror[i] = 2.0 * cosine * normal[i] - to_light[i];
    }
    let lobe = (exponent + 2.0) / (2.0 * pi) * dot(mirror, to_eye).powf(exponent);
    irradiance * cosine * (colour / pi + specular * lobe)
}

/// The mirror direction is twice the normal less the light's direction; I left out how long the light's part along the
/// normal is, and brought the vector to length 1.
fn fourth(
    [colour, specular, exponent]: [f64; 3],
    irradiance: f64,
    normal: [f64; 3],
    to_light: [f64; 3],
    to_eye: [f64; 3],
) -> f64 {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let pi = std::f64::consts::PI;
    let cosine = dot(normal, to_light);
    if cosine <= 0.0 {
        return 0.0;
    }
    let mirror = [2.0 * normal[0] - to_light[0], 2.0 * normal[1] - to_light[1], 2.0 * normal[2] - to_light[2]];
    let cos_alpha = (dot(mirror, to_eye) / dot(mirror, mirror).sqrt()).max(0.0);
    let lobe = specular * (exponent + 2.0) / (2.0 * pi) * cos_alpha.powf(exponent);
    irradiance * cosine * (colour / pi + lobe)
}

/// No more may leave than arrives, so the matte part gets only what the highlight leaves over, 1 − specular.
fn fifth(
    [colour, specular, exponent]: [f64; 3],
    irradiance: f64,
    normal: [f64; 3],
    to_light: [f64; 3],
    to_eye: [f64; 3],
) -> f64 {
    fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
    }
    let pi = std::f64::consts::PI;
    let cosine = dot(normal, to_light);
    if cosine <= 0.0 {
        return 0.0;
    }
    let cos_alpha = (2.0 * cosine * dot(normal, to_eye) - dot(to_light, to_eye)).max(0.0);
    let matte = (1.0 - specular) * colour / pi;
    let lobe = specular * (exponent + 2.0) / (2.0 * pi) * cos_alpha.powf(exponent);
    irradiance * cosine * (matte + lobe)
}

/// Colour and specular are what the two parts send on, so each is multiplied by what arrives.
fn sixth(
    [colour, specular, exponent]: [f64; 3],
    irradiance: f64,
    normal: [f64; 3],
    to_light: [f64; 3],
    to_eye: [f64; 3],
) -> f64 {
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let cosine = dot(normal, to_light);
    let alpha = 2.0 * cosine * dot(normal, to_eye) - dot(to_light, to_eye);
    let highlight = if alpha > 0.0 { specular * alpha.powf(exponent) } else { 0.0 };
    if cosine > 0.0 { (colour + highlight) * irradiance * cosine } else { 0.0 }
}
