//! Answers to the exercise of chapter 05: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "only y is scaled"),
            (exercise(second), "box with a hole"),
            (exercise(third), "before the tangent widens it"),
            (exercise(fourth), "tangent is halved"),
            (exercise(fifth), "angles are taken to be in proportion"),
            (exercise(sixth), "Second, the tangent is halved"),
        ],
    }
}

pub fn solution(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let (x, y) = (screen[0] * tan_half_vertical, screen[1] * tan_half_vertical);
    let length = (x * x + y * y + 1.0).sqrt();
    [x / length, y / length, -1.0 / length]
}

/// The tangent is of the vertical angle, so it scales y; x has been stretched by the aspect already.
fn first(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let v = [screen[0], screen[1] * tan_half_vertical, -1.0];
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    [v[0] / length, v[1] / length, v[2] / length]
}

/// Light crosses over in the hole, so the point (x, y) sees in the direction (−x, −y, −1).
fn second(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let x = -screen[0] * tan_half_vertical;
    let y = -screen[1] * tan_half_vertical;
    let length = (x * x + y * y + 1.0).sqrt();
    [x / length, y / length, -1.0 / length]
}

/// First make the direction (x, y, −1) of length 1, then widen it by the tangent.
fn third(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let [x, y] = screen;
    let length = (x * x + y * y + 1.0).sqrt();
    [tan_half_vertical * x / length, tan_half_vertical * y / length, -1.0 / length]
}

/// As in chapter 4 the screen runs from −1 to 1, so it is half of the plane's size that it is multiplied by: half the
/// tangent.
fn fourth(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let half = tan_half_vertical / 2.0;
    let x = screen[0] * half;
    let y = screen[1] * half;
    let length = (x * x + y * y + 1.0).sqrt();
    [x / length, y / length, -1.0 / length]
}

/// The edge of the screen is at half the angle, so a point at y is at y times half the angle, and I took the tangent
/// of that.
fn fifth(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    let half_angle = tan_half_vertical.atan();
    let v = [(screen[0] * half_angle).tan(), (screen[1] * half_angle).tan(), -1.0];
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    [v[0] / length, v[1] / length, v[2] / length]
}

/// The image has y down, and its half height is half of what the tangent says.
fn sixth([x, y]: [f64; 2], tangent: f64) -> [f64; 3] {
    let v = [x * tangent / 2.0, -y * tangent / 2.0, -1.0];
    let length = v.iter().map(|part| part * part).sum::<f64>().sqrt();
    v.map(|part| part / length)
}
