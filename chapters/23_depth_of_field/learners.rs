//! Answers that readers of chapter 23 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "the focus distance is measured along the pinhole's ray, so I normalise that first and go so far along it",
            exercise(a),
            "along the ray",
        ),
        (
            "the ray leads from the lens point to the place on the image plane (the plane in focus forgotten)",
            exercise(b),
            "always at distance 1",
        ),
        (
            "the point in focus is the place on the image plane pushed back to the depth z_f, with the same x and y",
            exercise(c),
            "only the depth",
        ),
        (
            "the screen point is already the place on the image plane (tangent forgotten)",
            exercise(d),
            "tangent is left out",
        ),
        (
            "a lens turns its picture upside down, so the lens point is added instead of subtracted",
            exercise(e),
            "lens point is added",
        ),
        (
            "P − O is the direction, and its length makes no difference, says the page (not normalised)",
            exercise(f),
            "not of length 1",
        ),
        (
            "The point in focus is where the pinhole's ray is, (x, y), at the depth z_f; I moved it back without moving it outward.",
            exercise(second_a),
            "only the depth is multiplied by the",
        ),
        (
            "The picture of the lens is upside down, so the lens point is added, not subtracted.",
            exercise(second_b),
            "the lens point is added; the",
        ),
        (
            "The distance to the image plane follows from the field of view as 1 over the tangent, so I divided the screen point by it.",
            exercise(second_c),
            "divided by the tangent",
        ),
    ]
}

fn right(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let x = screen[0] * tan_half_vertical - lens[0] / focus_distance;
    let y = screen[1] * tan_half_vertical - lens[1] / focus_distance;
    let l = (x * x + y * y + 1.0).sqrt();
    [x / l, y / l, -1.0 / l]
}

fn a(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let x = screen[0] * tan_half_vertical;
    let y = screen[1] * tan_half_vertical;
    let k = focus_distance / (x * x + y * y + 1.0).sqrt();
    let d = [k * x - lens[0], k * y - lens[1], -k];
    let l = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
    [d[0] / l, d[1] / l, d[2] / l]
}

fn b(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let _ = focus_distance;
    let x = screen[0] * tan_half_vertical - lens[0];
    let y = screen[1] * tan_half_vertical - lens[1];
    let l = (x * x + y * y + 1.0).sqrt();
    [x / l, y / l, -1.0 / l]
}

fn c(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let x = screen[0] * tan_half_vertical - lens[0];
    let y = screen[1] * tan_half_vertical - lens[1];
    let z = -focus_distance;
    let l = (x * x + y * y + z * z).sqrt();
    [x / l, y / l, z / l]
}

fn d(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let _ = tan_half_vertical;
    let x = screen[0] - lens[0] / focus_distance;
    let y = screen[1] - lens[1] / focus_distance;
    let l = (x * x + y * y + 1.0).sqrt();
    [x / l, y / l, -1.0 / l]
}

fn e(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let x = screen[0] * tan_half_vertical + lens[0] / focus_distance;
    let y = screen[1] * tan_half_vertical + lens[1] / focus_distance;
    let l = (x * x + y * y + 1.0).sqrt();
    [x / l, y / l, -1.0 / l]
}

fn f(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let p = [
        focus_distance * screen[0] * tan_half_vertical,
        focus_distance * screen[1] * tan_half_vertical,
        -focus_distance,
    ];
    [p[0] - lens[0], p[1] - lens[1], p[2]]
}

fn second_a(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let x = screen[0] * tan_half_vertical - lens[0];
    let y = screen[1] * tan_half_vertical - lens[1];
    let z = -focus_distance;
    let length = (x * x + y * y + z * z).sqrt();
    [x / length, y / length, z / length]
}

fn second_b(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let x = screen[0] * tan_half_vertical + lens[0] / focus_distance;
    let y = screen[1] * tan_half_vertical + lens[1] / focus_distance;
    let length = (x * x + y * y + 1.0).sqrt();
    [x / length, y / length, -1.0 / length]
}

fn second_c(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    let point = [
        screen[0] / tan_half_vertical * focus_distance,
        screen[1] / tan_half_vertical * focus_distance,
        -focus_distance,
    ];
    let d = [point[0] - lens[0], point[1] - lens[1], point[2]];
    let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
    [d[0] / length, d[1] / length, d[2] / length]
}
