//! Answers to the exercise of chapter 04: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "twice as far out"),
            (exercise(second), "rays spread"),
            (exercise(third), "direction is +z"),
            (exercise(fourth), "aspect is put into x once more"),
            (exercise(fifth), "from 0 to 1 with y down"),
            (exercise(sixth), "Second, the rays spread"),
        ],
    }
}

pub fn solution(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    let half = view_height / 2.0;
    ([screen[0] * half, screen[1] * half, 0.0], [0.0, 0.0, -1.0])
}

/// The rectangle is view_height high, so a screen point is multiplied by view_height.
fn first(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    ([screen[0] * view_height, screen[1] * view_height, 0.0], [0.0, 0.0, -1.0])
}

/// The ray starts on the rectangle and its direction goes from the camera through the square, brought to length 1.
fn second(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    let x = screen[0] * view_height / 2.0;
    let y = screen[1] * view_height / 2.0;
    let length = (x * x + y * y + 1.0).sqrt();
    ([x, y, 0.0], [x / length, y / length, -1.0 / length])
}

/// The rays are perpendicular to the rectangle, along the z axis, and the z axis is (0, 0, 1).
fn third(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    let half = 0.5 * view_height;
    ([screen[0] * half, screen[1] * half, 0.0], [0.0, 0.0, 1.0])
}

/// The rectangle is H times the aspect wide, so x needs the aspect of 480 by 270 as well.
fn fourth(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    let aspect = 480.0 / 270.0;
    let half = view_height / 2.0;
    ([screen[0] * half * aspect, screen[1] * half, 0.0], [0.0, 0.0, -1.0])
}

/// I thought that the screen point still runs from 0 to 1 with y down, so I brought it to −1 to 1 before I scaled it.
fn fifth(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    let x = 2.0 * screen[0] - 1.0;
    let y = 1.0 - 2.0 * screen[1];
    ([x * view_height / 2.0, y * view_height / 2.0, 0.0], [0.0, 0.0, -1.0])
}

/// The rectangle stands at z = −1, as in chapter 5, and the ray goes on from the eye through its place there.
fn sixth([x, y]: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    let (x, y) = (x * view_height / 2.0, y * view_height / 2.0);
    let length = (x * x + y * y + 1.0).sqrt();
    ([x, y, -1.0], [x / length, y / length, -1.0 / length])
}
