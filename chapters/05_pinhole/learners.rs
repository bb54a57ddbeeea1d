//! Answers that readers of chapter 05 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "v = (x tan, y tan, −1), so I take the tangent of the number that I am given",
            exercise(a),
            "taken of the tangent",
        ),
        (
            "the tangent is of the vertical angle, so it scales y; x has been stretched by the aspect already",
            exercise(b),
            "only y is scaled",
        ),
        (
            "the screen point stays as it is, and the plane is moved to the distance that the tangent says",
            exercise(c),
            "tangent is the plane's distance",
        ),
        (
            "light crosses over in the hole, so the point (x, y) sees in the direction (−x, −y, −1)",
            exercise(d),
            "box with a hole",
        ),
        (
            "first make the direction (x, y, −1) of length 1, then widen it by the tangent",
            exercise(e),
            "before the tangent widens it",
        ),
        (
            "as in chapter 4 the screen runs from −1 to 1, so it is half of the plane's size that it is multiplied by: half the tangent",
            exercise(f),
            "tangent is halved",
        ),
        (
            "The screen is 1 high above its middle, so I left x and y as they are and moved the plane to the tangent instead, at z = −T.",
            exercise(second_a),
            "the tangent is the plane's",
        ),
        (
            "I made the direction through (x, y, −1), brought it to length 1, and then scaled x and y by the tangent.",
            exercise(second_b),
            "the direction is brought to length",
        ),
        (
            "The edge of the screen is at half the angle, so a point at y is at y times half the angle, and I took the tangent of that.",
            exercise(second_c),
            "angles are taken to be in proportion",
        ),
    ]
}

fn right(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let x = screen[0] * tan_half_vertical;
    let y = screen[1] * tan_half_vertical;
    let length = (x * x + y * y + 1.0).sqrt();
    [x / length, y / length, -1.0 / length]
}

fn a(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let scale = tan_half_vertical.tan();
    let v = [screen[0] * scale, screen[1] * scale, -1.0];
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|part| part / length)
}

fn b(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let v = [screen[0], screen[1] * tan_half_vertical, -1.0];
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    [v[0] / length, v[1] / length, v[2] / length]
}

fn c(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let v = [screen[0], screen[1], -tan_half_vertical];
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    [v[0] / length, v[1] / length, v[2] / length]
}

fn d(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let x = -screen[0] * tan_half_vertical;
    let y = -screen[1] * tan_half_vertical;
    let length = (x * x + y * y + 1.0).sqrt();
    [x / length, y / length, -1.0 / length]
}

fn e(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let [x, y] = screen;
    let length = (x * x + y * y + 1.0).sqrt();
    [tan_half_vertical * x / length, tan_half_vertical * y / length, -1.0 / length]
}

fn f(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let half = tan_half_vertical / 2.0;
    let x = screen[0] * half;
    let y = screen[1] * half;
    let length = (x * x + y * y + 1.0).sqrt();
    [x / length, y / length, -1.0 / length]
}

fn second_a(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let v = [screen[0], screen[1], -tan_half_vertical];
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    [v[0] / length, v[1] / length, v[2] / length]
}

fn second_b(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let length = (screen[0] * screen[0] + screen[1] * screen[1] + 1.0).sqrt();
    let unit = [screen[0] / length, screen[1] / length, -1.0 / length];
    [unit[0] * tan_half_vertical, unit[1] * tan_half_vertical, unit[2]]
}

fn second_c(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let half_angle = tan_half_vertical.atan();
    let v = [(screen[0] * half_angle).tan(), (screen[1] * half_angle).tan(), -1.0];
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    [v[0] / length, v[1] / length, v[2] / length]
}
