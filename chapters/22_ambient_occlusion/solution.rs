//! A solution of the exercise of chapter 22; look here when you have done yours.

use std::f64::consts::TAU;

pub fn cosine_direction(u: f64, v: f64) -> [f64; 3] {
    let radius = u.sqrt();
    [radius * (TAU * v).cos(), radius * (TAU * v).sin(), (1.0 - u).sqrt()]
}
