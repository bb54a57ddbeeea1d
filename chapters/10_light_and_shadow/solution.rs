//! A solution of the exercise of chapter 10; look here when you have done yours.

use std::f64::consts::PI;

pub fn reflected_radiance(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    let v = [light[0] - position[0], light[1] - position[1], light[2] - position[2]];
    let distance_squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    let facing = normal[0] * v[0] + normal[1] * v[1] + normal[2] * v[2];
    if facing > 0.0 { colour / PI * intensity * (facing / distance_squared.sqrt()) / distance_squared } else { 0.0 }
}
