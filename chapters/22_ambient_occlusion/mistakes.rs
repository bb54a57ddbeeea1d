//! Typical wrong solutions of chapter 22, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::cosine_direction;
use pinhole_lab::exercise::Exercise;
use std::f64::consts::{PI, TAU};

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(cosine_direction)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|u, v| raised(u, TAU * v, (1.0 - u * u).sqrt())), "root is missing"),
        (exercise(|u, v| raised((1.0 - u * u).sqrt(), TAU * v, u)), "u is taken for the height"),
        (exercise(|u, v| raised((u * (2.0 - u)).sqrt(), TAU * v, 1.0 - u)), "1 − u is taken"),
        (exercise(|u, v| raised(u.sqrt(), PI * v, (1.0 - u).sqrt())), "half a turn"),
        (exercise(|u, v| raised(u.sqrt(), v, (1.0 - u).sqrt())), "taken for an angle"),
        (exercise(|u, v| raised(u.sqrt(), TAU * v, 1.0 - u)), "unit vector"),
        (exercise(|u, v| raised(u.sqrt(), TAU * v, -(1.0 - u).sqrt())), "points down"),
        (exercise(sine_first), "swapped"),
    ]
}

fn raised(radius: f64, turn: f64, height: f64) -> [f64; 3] {
    [radius * turn.cos(), radius * turn.sin(), height]
}

fn sine_first(u: f64, v: f64) -> [f64; 3] {
    [u.sqrt() * (TAU * v).sin(), u.sqrt() * (TAU * v).cos(), (1.0 - u).sqrt()]
}
