//! Answers to the exercise of chapter 33: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "to the left it is a bottom edge"),
            (exercise(second), "bias of −1"),
            (exercise(third), "overflow i32"),
            (exercise(fourth), "drops their fractions"),
            (exercise(fifth), "on the image's right"),
            (exercise(sixth), "measured from different ends"),
        ],
    }
}

pub fn solution(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let [fx, fy] = from.map(i64::from);
    let [tx, ty] = to.map(i64::from);
    let [x, y] = sample.map(i64::from);
    let area = (tx - fx) * (y - fy) - (ty - fy) * (x - fx);
    let is_left = ty < fy;
    let is_top = ty == fy && tx > fx;
    area > 0 || (area == 0 && (is_left || is_top))
}

/// On the edge it is inside if the edge goes up or is level (which way a level edge goes forgotten).
fn first(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let dx = (to[0] - from[0]) as i64;
    let dy = (to[1] - from[1]) as i64;
    let area = dx * (sample[1] - from[1]) as i64 - dy * (sample[0] - from[0]) as i64;
    area > 0 || (area == 0 && dy <= 0)
}

/// I remember the bias of 0 for top and left edges and −1 for the others, and compare the sum by > 0 (off by one).
fn second(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let dx = (to[0] - from[0]) as i64;
    let dy = (to[1] - from[1]) as i64;
    let bias = if dy < 0 || (dy == 0 && dx > 0) { 0 } else { -1 };
    dx * (sample[1] - from[1]) as i64 - dy * (sample[0] - from[0]) as i64 + bias > 0
}

/// All are i32, so E is one too, and where the program complained of an overflow I let it wrap.
fn third(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let dx = to[0] - from[0];
    let dy = to[1] - from[1];
    let first = dx.wrapping_mul(sample[1] - from[1]);
    let second = dy.wrapping_mul(sample[0] - from[0]);
    let area = first.wrapping_sub(second);
    area > 0 || (area == 0 && (dy < 0 || (dy == 0 && dx > 0)))
}

/// Coordinates are in 1/256 of a pixel, so I first divide them by 256 to have pixels.
fn fourth(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let dx = (to[0] / 256 - from[0] / 256) as i64;
    let dy = (to[1] / 256 - from[1] / 256) as i64;
    let qx = (sample[0] / 256 - from[0] / 256) as i64;
    let qy = (sample[1] / 256 - from[1] / 256) as i64;
    let area = dx * qy - dy * qx;
    area > 0 || (area == 0 && (dy < 0 || (dy == 0 && dx > 0)))
}

/// The inside is to the right of the edge, so I compute the edge's x at the height of the sample and ask whether the
/// sample's is larger.
fn fifth(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let dx = (to[0] - from[0]) as f64;
    let dy = (to[1] - from[1]) as f64;
    let px = (sample[0] - from[0]) as f64;
    let py = (sample[1] - from[1]) as f64;
    if dy == 0.0 {
        if py == 0.0 {
            return dx > 0.0;
        }
        return py > 0.0;
    }
    let edge = dx * py / dy;
    if px == edge {
        return dy < 0.0;
    }
    px > edge
}

/// I wrote the area down from memory and measured the sample's y from the edge's end, but its x from the beginning.
fn sixth(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let dx = (to[0] - from[0]) as i64;
    let dy = (to[1] - from[1]) as i64;
    let area = dx * (sample[1] - to[1]) as i64 - dy * (sample[0] - from[0]) as i64;
    area > 0 || (area == 0 && (dy < 0 || (dy == 0 && dx > 0)))
}
