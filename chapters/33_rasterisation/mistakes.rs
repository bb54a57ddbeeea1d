//! Typical wrong solutions of chapter 33, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::is_inside_edge;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(is_inside_edge)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|from, to, sample| area(from, to, sample) > 0), "a crack"),
        (exercise(|from, to, sample| area(from, to, sample) >= 0), "belongs to both"),
        (exercise(to_the_left), "to the left"),
        (
            exercise(|[fx, fy], [tx, ty], s| is_inside_edge([fx, fy], [tx, ty], s) && !on_level(fy, ty, s)),
            "level edges",
        ),
        (exercise(in_i32), "overflow"),
    ]
}

fn area([fx, fy]: [i32; 2], [tx, ty]: [i32; 2], [x, y]: [i32; 2]) -> i64 {
    i64::from(tx - fx) * i64::from(y - fy) - i64::from(ty - fy) * i64::from(x - fx)
}

fn on_level(from: i32, to: i32, [_, y]: [i32; 2]) -> bool {
    from == to && y == from
}

fn to_the_left(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let [x, y] = sample;
    // The sample on the other side of the edge, as far off.
    is_inside_edge(from, to, [from[0] + to[0] - x, from[1] + to[1] - y])
}

fn in_i32([fx, fy]: [i32; 2], [tx, ty]: [i32; 2], [x, y]: [i32; 2]) -> bool {
    let area = (tx - fx).wrapping_mul(y - fy).wrapping_sub((ty - fy).wrapping_mul(x - fx));
    area > 0 || (area == 0 && (ty < fy || (ty == fy && tx > fx)))
}
