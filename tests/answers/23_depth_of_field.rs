//! Answers to the exercise of chapter 23: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "along the ray"),
            (exercise(second), "always at distance 1"),
            (exercise(third), "lens point is added"),
            (exercise(fourth), "not of length 1"),
            (exercise(fifth), "divided by the tangent"),
            (exercise(sixth), "Second, the direction is not of length 1"),
        ],
    }
}

pub fn solution(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let x = screen[0] * tan_half_vertical * focus_distance - lens[0];
    let y = screen[1] * tan_half_vertical * focus_distance - lens[1];
    let length = (x * x + y * y + focus_distance * focus_distance).sqrt();
    [x / length, y / length, -focus_distance / length]
}

/// The focus distance is measured along the pinhole's ray, so I normalise that first and go so far along it.
fn first(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let x = screen[0] * tan_half_vertical;
    let y = screen[1] * tan_half_vertical;
    let k = focus_distance / (x * x + y * y + 1.0).sqrt();
    let d = [k * x - lens[0], k * y - lens[1], -k];
    let l = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
    [d[0] / l, d[1] / l, d[2] / l]
}

/// The ray leads from the lens point to the place on the image plane (the plane in focus forgotten).
fn second(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let _ = focus_distance;
    let x = screen[0] * tan_half_vertical - lens[0];
    let y = screen[1] * tan_half_vertical - lens[1];
    let l = (x * x + y * y + 1.0).sqrt();
    [x / l, y / l, -1.0 / l]
}

/// A lens turns its picture upside down, so the lens point is added instead of subtracted.
fn third(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let x = screen[0] * tan_half_vertical + lens[0] / focus_distance;
    let y = screen[1] * tan_half_vertical + lens[1] / focus_distance;
    let l = (x * x + y * y + 1.0).sqrt();
    [x / l, y / l, -1.0 / l]
}

/// P − O is the direction, and its length makes no difference, says the page (not normalised).
fn fourth(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let p = [
        focus_distance * screen[0] * tan_half_vertical,
        focus_distance * screen[1] * tan_half_vertical,
        -focus_distance,
    ];
    [p[0] - lens[0], p[1] - lens[1], p[2]]
}

/// The distance to the image plane follows from the field of view as 1 over the tangent, so I divided the screen point
/// by it.
fn fifth(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let point = [
        screen[0] / tan_half_vertical * focus_distance,
        screen[1] / tan_half_vertical * focus_distance,
        -focus_distance,
    ];
    let d = [point[0] - lens[0], point[1] - lens[1], point[2]];
    let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
    [d[0] / length, d[1] / length, d[2] / length]
}

/// The ray starts on the lens, so its point is added, and the direction is what comes out.
fn sixth([x, y]: [f64; 2], tangent: f64, lens: [f64; 2], focus: f64) -> [f64; 3] {
    [x * tangent * focus + lens[0], y * tangent * focus + lens[1], -focus]
}
