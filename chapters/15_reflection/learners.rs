//! Answers that readers of chapter 15 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "the highlight is the cosine between the normal and the half vector, to the power n, with the factor (n + 2)/2π",
            exercise(a),
            "about the half vector",
        ),
        (
            "the cosine is Lambert's and belongs to the matte part; the highlight has its own cosine",
            exercise(b),
            "forgotten in the highlight",
        ),
        (
            "reflecting a vector is v − 2 (v·n) n, as in every graphics library, with v the direction to the light",
            exercise(c),
            "points into the surface",
        ),
        (
            "the lobe cosⁿ over the hemisphere integrates to 2π/(n + 1), so the factor is (n + 1)/2π",
            exercise(d),
            "(n + 1) / 2π",
        ),
        (
            "the eye is on the normal's side, so the cosine with the mirror direction cannot be negative and needs no test",
            exercise(e),
            "more than 90° from the mirrored light",
        ),
        (
            "what the highlight takes is missing from the matte part, so together they stay at most 1: colour times (1 − specular)",
            exercise(f),
            "lessened by what the other reflects",
        ),
        (
            "The mirror direction is twice the normal less the light's direction; I left out how long the light's part along the normal is, and brought the vector to length 1.",
            exercise(second_a),
            "normalising does not replace it",
        ),
        (
            "No more may leave than arrives, so the matte part gets only what the highlight leaves over, 1 − specular.",
            exercise(second_b),
            "one part is lessened by what the",
        ),
        (
            "A reflectance becomes a BRDF by dividing it by π, so I divided the sum of colour and highlight by π, though the highlight's factor already has its own.",
            exercise(second_c),
            "the factor of the highlight is",
        ),
    ]
}

fn right(
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

fn a(
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

fn b(
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
    let diffuse = irradiance * cosine * colour / pi;
    let highlight = irradiance * specular * (exponent + 2.0) / (2.0 * pi) * alpha.powf(exponent);
    diffuse + highlight
}

fn c(
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
        mirror[i] = to_light[i] - 2.0 * cosine * normal[i];
    }
    let alpha = dot(mirror, to_eye).max(0.0);
    let lobe = (exponent + 2.0) / (2.0 * pi) * alpha.powf(exponent);
    irradiance * cosine * (colour / pi + specular * lobe)
}

fn d(
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

fn e(
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

fn f(
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
    irradiance * cosine * ((1.0 - specular) * colour / pi + specular * lobe)
}

fn second_a(
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

fn second_b(
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

fn second_c(
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
    let lobe = specular * (exponent + 2.0) / (2.0 * pi) * cos_alpha.powf(exponent);
    irradiance * cosine * (colour + lobe) / pi
}
