//! Answers to the exercise of chapter 22: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;
use std::f64::consts::TAU;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: Some(exercise(textbook)),
        wrong: [
            (exercise(first), "taken for the radius"),
            (exercise(second), "half a turn"),
            (exercise(third), "u and 1 − u are swapped"),
            (exercise(fourth), "the height is not that of a unit"),
            (exercise(fifth), "goes with the cosine squared"),
            (exercise(sixth), "Second, the height is not that"),
        ],
    }
}

pub fn solution(u: f64, v: f64) -> [f64; 3] {
    let radius = u.sqrt();
    [radius * (TAU * v).cos(), radius * (TAU * v).sin(), (1.0 - u).sqrt()]
}

/// The formula straight from the page.
fn textbook(u: f64, v: f64) -> [f64; 3] {
    let r = u.sqrt();
    let phi = 2.0 * std::f64::consts::PI * v;
    [r * phi.cos(), r * phi.sin(), (1.0 - u).sqrt()]
}

/// U says how far from the middle the foot is, so r = u, and z is what remains of length 1.
fn first(u: f64, v: f64) -> [f64; 3] {
    let phi = 2.0 * std::f64::consts::PI * v;
    [u * phi.cos(), u * phi.sin(), (1.0 - u * u).sqrt()]
}

/// Π makes a full turn (half of it forgotten).
fn second(u: f64, v: f64) -> [f64; 3] {
    let r = u.sqrt();
    let phi = std::f64::consts::PI * v;
    [r * phi.cos(), r * phi.sin(), (1.0 - u).sqrt()]
}

/// The pdf goes with the cosine, so cos = √u as I know it from other programs, and the radius is the rest.
fn third(u: f64, v: f64) -> [f64; 3] {
    let z = u.sqrt();
    let r = (1.0 - u).sqrt();
    let phi = 2.0 * std::f64::consts::PI * v;
    [r * phi.cos(), r * phi.sin(), z]
}

/// R is the root of u, and what is left of the length 1 for z is 1 − r.
fn fourth(u: f64, v: f64) -> [f64; 3] {
    let r = u.sqrt();
    let angle = 2.0 * std::f64::consts::PI * v;
    [r * angle.cos(), r * angle.sin(), 1.0 - r]
}

/// I remembered the Phong lobe: for a power n of the cosine, z is a number to the power 1/(n + 2), with n = 1 a cube
/// root.
fn fifth(u: f64, v: f64) -> [f64; 3] {
    let z = (1.0 - u).powf(1.0 / 3.0);
    let r = (1.0 - z * z).max(0.0).sqrt();
    let angle = 2.0 * std::f64::consts::PI * v;
    [r * angle.cos(), r * angle.sin(), z]
}

/// V turns by up to π, and u is taken off the height.
fn sixth(u: f64, v: f64) -> [f64; 3] {
    let turn = std::f64::consts::PI * v;
    [u.sqrt() * turn.cos(), u.sqrt() * turn.sin(), 1.0 - u]
}
