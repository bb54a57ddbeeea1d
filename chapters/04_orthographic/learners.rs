//! Answers that readers of chapter 04 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "the rectangle is view_height high, so a screen point is multiplied by view_height",
            exercise(a),
            "twice as far out",
        ),
        (
            "the rectangle stands one unit in front of the camera, so the rays start at z = −1",
            exercise(b),
            "stands at z = −1",
        ),
        (
            "the ray starts on the rectangle and its direction goes from the camera through the square, brought to length 1",
            exercise(c),
            "rays spread",
        ),
        (
            "the rays are perpendicular to the rectangle, along the z axis, and the z axis is (0, 0, 1)",
            exercise(d),
            "direction is +z",
        ),
        (
            "the rectangle is H times the aspect wide, so x needs the aspect of 480 by 270 as well",
            exercise(e),
            "aspect is put into x once more",
        ),
        (
            "the screen point times the height is the place on the rectangle, and half a height must be taken off because the centre is at 0",
            exercise(f),
            "counted from a corner",
        ),
        (
            "Every ray goes through its screen point, so I let it start on the rectangle and go on away from the middle, as rays through a picture do.",
            exercise(second_a),
            "the rays spread",
        ),
        (
            "I thought that the screen point still runs from 0 to 1 with y down, so I brought it to −1 to 1 before I scaled it.",
            exercise(second_b),
            "from 0 to 1 with y down",
        ),
        (
            "The screen's x is already longer than its y by the aspect, so only y has to be scaled to the view height.",
            exercise(second_c),
            "only y is scaled by half the",
        ),
    ]
}

fn right(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    let half = view_height / 2.0;
    ([screen[0] * half, screen[1] * half, 0.0], [0.0, 0.0, -1.0])
}

fn a(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    ([screen[0] * view_height, screen[1] * view_height, 0.0], [0.0, 0.0, -1.0])
}

fn b(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    let half = view_height / 2.0;
    ([screen[0] * half, screen[1] * half, -1.0], [0.0, 0.0, -1.0])
}

fn c(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    let x = screen[0] * view_height / 2.0;
    let y = screen[1] * view_height / 2.0;
    let length = (x * x + y * y + 1.0).sqrt();
    ([x, y, 0.0], [x / length, y / length, -1.0 / length])
}

fn d(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    let half = 0.5 * view_height;
    ([screen[0] * half, screen[1] * half, 0.0], [0.0, 0.0, 1.0])
}

fn e(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    let aspect = 480.0 / 270.0;
    let half = view_height / 2.0;
    ([screen[0] * half * aspect, screen[1] * half, 0.0], [0.0, 0.0, -1.0])
}

fn f(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    let x = screen[0] * view_height - view_height / 2.0;
    let y = screen[1] * view_height - view_height / 2.0;
    ([x, y, 0.0], [0.0, 0.0, -1.0])
}

fn second_a(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    let x = screen[0] * view_height / 2.0;
    let y = screen[1] * view_height / 2.0;
    let length = (x * x + y * y + 1.0).sqrt();
    ([x, y, 0.0], [x / length, y / length, -1.0 / length])
}

fn second_b(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    let x = 2.0 * screen[0] - 1.0;
    let y = 1.0 - 2.0 * screen[1];
    ([x * view_height / 2.0, y * view_height / 2.0, 0.0], [0.0, 0.0, -1.0])
}

fn second_c(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    ([screen[0], screen[1] * view_height / 2.0, 0.0], [0.0, 0.0, -1.0])
}
