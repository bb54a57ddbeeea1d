//! Answers that readers of chapter 22 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "u says how far from the middle the foot is, so r = u, and z is what remains of length 1",
            exercise(a),
            "taken for the radius",
        ),
        (
            "u leads from the pole to the rim, so the angle to +z is u times a right angle",
            exercise(b),
            "taken for the angle",
        ),
        ("π makes a full turn (half of it forgotten)", exercise(c), "half a turn"),
        (
            "the page says z² = 1 − u, and I take that for z (the root forgotten)",
            exercise(d),
            "not that of a unit vector",
        ),
        (
            "the pdf goes with the cosine, so cos = √u as I know it from other programs, and the radius is the rest",
            exercise(e),
            "u and 1 − u are swapped",
        ),
        (
            "a turn about z begins at +y and goes towards +x, as on a compass (sine and cosine exchanged)",
            exercise(f),
            "are swapped: it starts",
        ),
        (
            "r is the root of u, and what is left of the length 1 for z is 1 − r.",
            exercise(second_a),
            "the height is not that of a unit",
        ),
        (
            "The cosine to +z is the root of a uniform number, so z is the root of u and the radius what remains.",
            exercise(second_b),
            "u and 1 − u are swapped: u is the",
        ),
        (
            "I remembered the Phong lobe: for a power n of the cosine, z is a number to the power 1/(n + 2), with n = 1 a cube root.",
            exercise(second_c),
            "goes with the cosine squared",
        ),
    ]
}

fn right(u: f64, v: f64) -> [f64; 3] {
    let r = u.sqrt();
    let phi = 2.0 * std::f64::consts::PI * v;
    [r * phi.cos(), r * phi.sin(), (1.0 - u).sqrt()]
}

fn a(u: f64, v: f64) -> [f64; 3] {
    let phi = 2.0 * std::f64::consts::PI * v;
    [u * phi.cos(), u * phi.sin(), (1.0 - u * u).sqrt()]
}

fn b(u: f64, v: f64) -> [f64; 3] {
    let theta = u * std::f64::consts::FRAC_PI_2;
    let phi = 2.0 * std::f64::consts::PI * v;
    [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()]
}

fn c(u: f64, v: f64) -> [f64; 3] {
    let r = u.sqrt();
    let phi = std::f64::consts::PI * v;
    [r * phi.cos(), r * phi.sin(), (1.0 - u).sqrt()]
}

fn d(u: f64, v: f64) -> [f64; 3] {
    let r = u.sqrt();
    let phi = 2.0 * std::f64::consts::PI * v;
    [r * phi.cos(), r * phi.sin(), 1.0 - r * r]
}

fn e(u: f64, v: f64) -> [f64; 3] {
    let z = u.sqrt();
    let r = (1.0 - u).sqrt();
    let phi = 2.0 * std::f64::consts::PI * v;
    [r * phi.cos(), r * phi.sin(), z]
}

fn f(u: f64, v: f64) -> [f64; 3] {
    let r = u.sqrt();
    let phi = 2.0 * std::f64::consts::PI * v;
    [r * phi.sin(), r * phi.cos(), (1.0 - u).sqrt()]
}

fn second_a(u: f64, v: f64) -> [f64; 3] {
    let r = u.sqrt();
    let angle = 2.0 * std::f64::consts::PI * v;
    [r * angle.cos(), r * angle.sin(), 1.0 - r]
}

fn second_b(u: f64, v: f64) -> [f64; 3] {
    let z = u.sqrt();
    let r = (1.0 - u).sqrt();
    let angle = 2.0 * std::f64::consts::PI * v;
    [r * angle.cos(), r * angle.sin(), z]
}

fn second_c(u: f64, v: f64) -> [f64; 3] {
    let z = (1.0 - u).powf(1.0 / 3.0);
    let r = (1.0 - z * z).max(0.0).sqrt();
    let angle = 2.0 * std::f64::consts::PI * v;
    [r * angle.cos(), r * angle.sin(), z]
}
