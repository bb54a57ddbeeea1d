//! Answers that readers of chapter 33 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "an edge that goes up has a growing y, and a top edge on the way round goes to the left (y down forgotten in the rule)",
            exercise(a),
            "turned round, to bottom",
        ),
        (
            "a positive cross product means to the left, as in mathematics, so right is where E is negative",
            exercise(b),
            "inside is to the left",
        ),
        (
            "on the edge it is inside if the edge goes up or is level (which way a level edge goes forgotten)",
            exercise(c),
            "to the left it is a bottom edge",
        ),
        (
            "I remember the bias of 0 for top and left edges and −1 for the others, and compare the sum by > 0 (off by one)",
            exercise(d),
            "bias of −1",
        ),
        (
            "all are i32, so E is one too, and where the program complained of an overflow I let it wrap",
            exercise(e),
            "overflow i32",
        ),
        (
            "coordinates are in 1/256 of a pixel, so I first divide them by 256 to have pixels",
            exercise(f),
            "drops their fractions",
        ),
        (
            "The inside is to the right of the edge, so I compute the edge's x at the height of the sample and ask whether the sample's is larger.",
            exercise(second_a),
            "on the image's right",
        ),
        (
            "I wrote the area down from memory and measured the sample's y from the edge's end, but its x from the beginning.",
            exercise(second_b),
            "measured from different ends",
        ),
        (
            "A pixel is sampled in its middle, and half a pixel is 128 of these steps, so I added 128 to the sample's coordinates.",
            exercise(second_c),
            "half a pixel is added to the sample",
        ),
    ]
}

fn right(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let dx = (to[0] - from[0]) as i64;
    let dy = (to[1] - from[1]) as i64;
    let area = dx * (sample[1] - from[1]) as i64 - dy * (sample[0] - from[0]) as i64;
    area > 0 || (area == 0 && (dy < 0 || (dy == 0 && dx > 0)))
}

fn a(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let dx = (to[0] - from[0]) as i64;
    let dy = (to[1] - from[1]) as i64;
    let area = dx * (sample[1] - from[1]) as i64 - dy * (sample[0] - from[0]) as i64;
    if area != 0 {
        return area > 0;
    }
    dy > 0 || (dy == 0 && dx < 0)
}

fn b(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let dx = (to[0] - from[0]) as i64;
    let dy = (to[1] - from[1]) as i64;
    let area = dx * (sample[1] - from[1]) as i64 - dy * (sample[0] - from[0]) as i64;
    if area < 0 {
        return true;
    }
    area == 0 && (dy < 0 || (dy == 0 && dx > 0))
}

fn c(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let dx = (to[0] - from[0]) as i64;
    let dy = (to[1] - from[1]) as i64;
    let area = dx * (sample[1] - from[1]) as i64 - dy * (sample[0] - from[0]) as i64;
    area > 0 || (area == 0 && dy <= 0)
}

fn d(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let dx = (to[0] - from[0]) as i64;
    let dy = (to[1] - from[1]) as i64;
    let bias = if dy < 0 || (dy == 0 && dx > 0) { 0 } else { -1 };
    dx * (sample[1] - from[1]) as i64 - dy * (sample[0] - from[0]) as i64 + bias > 0
}

fn e(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let dx = to[0] - from[0];
    let dy = to[1] - from[1];
    let first = dx.wrapping_mul(sample[1] - from[1]);
    let second = dy.wrapping_mul(sample[0] - from[0]);
    let area = first.wrapping_sub(second);
    area > 0 || (area == 0 && (dy < 0 || (dy == 0 && dx > 0)))
}

fn f(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let dx = (to[0] / 256 - from[0] / 256) as i64;
    let dy = (to[1] / 256 - from[1] / 256) as i64;
    let qx = (sample[0] / 256 - from[0] / 256) as i64;
    let qy = (sample[1] / 256 - from[1] / 256) as i64;
    let area = dx * qy - dy * qx;
    area > 0 || (area == 0 && (dy < 0 || (dy == 0 && dx > 0)))
}

fn second_a(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
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

fn second_b(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let dx = (to[0] - from[0]) as i64;
    let dy = (to[1] - from[1]) as i64;
    let area = dx * (sample[1] - to[1]) as i64 - dy * (sample[0] - from[0]) as i64;
    area > 0 || (area == 0 && (dy < 0 || (dy == 0 && dx > 0)))
}

fn second_c(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let dx = (to[0] - from[0]) as i64;
    let dy = (to[1] - from[1]) as i64;
    let px = (sample[0] - from[0]) as i64 + 128;
    let py = (sample[1] - from[1]) as i64 + 128;
    let area = dx * py - dy * px;
    area > 0 || (area == 0 && (dy < 0 || (dy == 0 && dx > 0)))
}
