//! Answers that readers of chapter 10 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "the cosine is the dot product of the normal and the vector to the light",
            exercise(a),
            "thins out with the distance once",
        ),
        (
            "the light has spread over a sphere of area 4π d², so the intensity is divided by that",
            exercise(b),
            "divided by 4π",
        ),
        (
            "light travels from the lamp to the surface, so its direction is position − light",
            exercise(c),
            "opposite is meant",
        ),
        (
            "a normal may point to either side and light is never negative, so I take the absolute value of the cosine",
            exercise(d),
            "lit from behind",
        ),
        (
            "a matte surface sends the light into the hemisphere, and the hemisphere has 2π, so the albedo is divided by 2π",
            exercise(e),
            "not colour / 2π",
        ),
        (
            "a point at the light's own place is one that is nearer than 0.0001, since f64 numbers are never exactly equal",
            exercise(f),
            "light close by",
        ),
        (
            "The cosine is the dot product of the normal and the direction to the light; I forgot that light − position does not have length 1.",
            exercise(second_a),
            "the light thins out with the",
        ),
        (
            "Extraction has already made lights relative, so I took `light` itself for the vector to the light.",
            exercise(second_b),
            "the position is left out: the light",
        ),
        (
            "The surface sends its light into a hemisphere, and that is 2π steradians, so I spread it over 2π.",
            exercise(second_c),
            "the BRDF is colour / π, not colour",
        ),
    ]
}

fn right(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let d = [light[0] - position[0], light[1] - position[1], light[2] - position[2]];
    let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    let cosine = (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]) / squared.sqrt();
    if cosine > 0.0 { colour / std::f64::consts::PI * intensity * cosine / squared } else { 0.0 }
}

fn a(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let d = [light[0] - position[0], light[1] - position[1], light[2] - position[2]];
    let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    let cosine = normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2];
    if cosine > 0.0 && squared > 0.0 { colour / std::f64::consts::PI * intensity * cosine / squared } else { 0.0 }
}

fn b(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let pi = std::f64::consts::PI;
    let d = [light[0] - position[0], light[1] - position[1], light[2] - position[2]];
    let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    let cosine = (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]) / squared.sqrt();
    if !(cosine > 0.0) {
        return 0.0;
    }
    let irradiance = intensity * cosine / (4.0 * pi * squared);
    colour / pi * irradiance
}

fn c(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let d = [position[0] - light[0], position[1] - light[1], position[2] - light[2]];
    let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    let cosine = (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]) / squared.sqrt();
    if cosine > 0.0 { colour / std::f64::consts::PI * intensity * cosine / squared } else { 0.0 }
}

fn d(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let d = [light[0] - position[0], light[1] - position[1], light[2] - position[2]];
    let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if squared == 0.0 {
        return 0.0;
    }
    let cosine = (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]) / squared.sqrt();
    colour / std::f64::consts::PI * intensity * cosine.abs() / squared
}

fn e(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let d = [light[0] - position[0], light[1] - position[1], light[2] - position[2]];
    let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    let cosine = (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]) / squared.sqrt();
    if cosine > 0.0 { colour / (2.0 * std::f64::consts::PI) * intensity * cosine / squared } else { 0.0 }
}

fn f(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let d = [light[0] - position[0], light[1] - position[1], light[2] - position[2]];
    let distance = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
    if distance < 1e-4 {
        return 0.0;
    }
    let cosine = (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]) / distance;
    colour / std::f64::consts::PI * intensity * cosine.max(0.0) / (distance * distance)
}

fn second_a(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let to = [light[0] - position[0], light[1] - position[1], light[2] - position[2]];
    let square = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
    let cosine = normal[0] * to[0] + normal[1] * to[1] + normal[2] * to[2];
    if cosine <= 0.0 || square == 0.0 {
        return 0.0;
    }
    colour / std::f64::consts::PI * intensity * cosine / square
}

fn second_b(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let square = light[0] * light[0] + light[1] * light[1] + light[2] * light[2];
    if square == 0.0 || light == position {
        return 0.0;
    }
    let distance = square.sqrt();
    let cosine = (normal[0] * light[0] + normal[1] * light[1] + normal[2] * light[2]) / distance;
    colour / std::f64::consts::PI * intensity * cosine.max(0.0) / square
}

fn second_c(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let to = [light[0] - position[0], light[1] - position[1], light[2] - position[2]];
    let square = to[0] * to[0] + to[1] * to[1] + to[2] * to[2];
    if square == 0.0 {
        return 0.0;
    }
    let cosine = (normal[0] * to[0] + normal[1] * to[1] + normal[2] * to[2]) / square.sqrt();
    let irradiance = intensity * cosine.max(0.0) / square;
    colour / (2.0 * std::f64::consts::PI) * irradiance
}
