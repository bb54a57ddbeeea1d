//! Answers to the exercise of chapter 10: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;
use std::f64::consts::PI;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "thins out with the distance once"),
            (exercise(second), "opposite is meant"),
            (exercise(third), "lit from behind"),
            (exercise(fourth), "not colour / 2π"),
            (exercise(fifth), "light close by"),
            (exercise(sixth), "Second, the light thins out with the distance once"),
        ],
    }
}

pub fn solution(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let v = [light[0] - position[0], light[1] - position[1], light[2] - position[2]];
    let distance_squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    let facing = normal[0] * v[0] + normal[1] * v[1] + normal[2] * v[2];
    if facing > 0.0 { colour / PI * intensity * (facing / distance_squared.sqrt()) / distance_squared } else { 0.0 }
}

/// The cosine is the dot product of the normal and the vector to the light.
fn first(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let d = [light[0] - position[0], light[1] - position[1], light[2] - position[2]];
    let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    let cosine = normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2];
    if cosine > 0.0 && squared > 0.0 { colour / std::f64::consts::PI * intensity * cosine / squared } else { 0.0 }
}

/// Light travels from the lamp to the surface, so its direction is position − light.
fn second(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let d = [position[0] - light[0], position[1] - light[1], position[2] - light[2]];
    let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    let cosine = (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]) / squared.sqrt();
    if cosine > 0.0 { colour / std::f64::consts::PI * intensity * cosine / squared } else { 0.0 }
}

/// A normal may point to either side and light is never negative, so I take the absolute value of the cosine.
fn third(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let d = [light[0] - position[0], light[1] - position[1], light[2] - position[2]];
    let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if squared == 0.0 {
        return 0.0;
    }
    let cosine = (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]) / squared.sqrt();
    colour / std::f64::consts::PI * intensity * cosine.abs() / squared
}

/// A matte surface sends the light into the hemisphere, and the hemisphere has 2π, so the albedo is divided by 2π.
fn fourth(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let d = [light[0] - position[0], light[1] - position[1], light[2] - position[2]];
    let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    let cosine = (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]) / squared.sqrt();
    if cosine > 0.0 { colour / (2.0 * std::f64::consts::PI) * intensity * cosine / squared } else { 0.0 }
}

/// A point at the light's own place is one that is nearer than 0.0001, since f64 numbers are never exactly equal.
fn fifth(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let d = [light[0] - position[0], light[1] - position[1], light[2] - position[2]];
    let distance = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
    if distance < 1e-4 {
        return 0.0;
    }
    let cosine = (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]) / distance;
    colour / std::f64::consts::PI * intensity * cosine.max(0.0) / (distance * distance)
}

/// The surface sends its colour on, and the light thins out as it goes.
fn sixth(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let v = [0, 1, 2].map(|axis| light[axis] - position[axis]);
    let distance = v.iter().map(|part| part * part).sum::<f64>().sqrt();
    let cosine = normal.iter().zip(v).map(|(n, v)| n * v).sum::<f64>() / distance;
    if cosine > 0.0 { colour * intensity * cosine / distance } else { 0.0 }
}
