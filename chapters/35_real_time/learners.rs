//! Answers that readers of chapter 35 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "s is how far the neighbour lies from the plane, that is normal · offset (not divided by the offset's length)",
            exercise(a),
            "scene's units",
        ),
        (
            "the dot product with the normal is a cosine, so the sine is √(1 − that²) (the angle to the normal, not to the plane)",
            exercise(b),
            "that is the cosine",
        ),
        (
            "the 32nd power makes everything beyond 90° vanish by itself (but an even power of −1 is 1)",
            exercise(c),
            "face away",
        ),
        (
            "0.01 / (0.01 + s) with the absolute value of the sine (the square forgotten)",
            exercise(d),
            "sine is not squared",
        ),
        (
            "the neighbour's plane is the one across the neighbour's normal, so I take that for the sine",
            exercise(e),
            "neighbour's plane",
        ),
        (
            "the product of the cosine and the plane's factor, all of it to the 32nd power",
            exercise(f),
            "both factors are raised",
        ),
        (
            "The page says the weight falls with the neighbour's distance from the tangent plane, so s is the offset's dot product with the normal.",
            exercise(second_a),
            "the distance from the plane is not",
        ),
        (
            "The dot product of the unit offset with the normal is a cosine, and since a sine is asked for I took 1 minus its square.",
            exercise(second_b),
            "that is the cosine, the part along",
        ),
        (
            "I put the sine itself into the second factor, without its sign, and overlooked the square.",
            exercise(second_c),
            "the sine is not squared: at 0.1 the",
        ),
    ]
}

fn right(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let c = normal[0] * neighbour[0] + normal[1] * neighbour[1] + normal[2] * neighbour[2];
    let l = (offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]).sqrt();
    let s = (normal[0] * offset[0] + normal[1] * offset[1] + normal[2] * offset[2]) / l;
    c.max(0.0).powi(32) * 0.01 / (0.01 + s * s)
}

fn a(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let c = normal[0] * neighbour[0] + normal[1] * neighbour[1] + normal[2] * neighbour[2];
    let s = normal[0] * offset[0] + normal[1] * offset[1] + normal[2] * offset[2];
    c.max(0.0).powi(32) * 0.01 / (0.01 + s * s)
}

fn b(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let c = normal[0] * neighbour[0] + normal[1] * neighbour[1] + normal[2] * neighbour[2];
    let l2 = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
    if l2 == 0.0 {
        return c.max(0.0).powi(32);
    }
    let p = normal[0] * offset[0] + normal[1] * offset[1] + normal[2] * offset[2];
    let s2 = 1.0 - p * p / l2;
    c.max(0.0).powi(32) * 0.01 / (0.01 + s2)
}

fn c(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let c = normal[0] * neighbour[0] + normal[1] * neighbour[1] + normal[2] * neighbour[2];
    let l2 = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
    let p = normal[0] * offset[0] + normal[1] * offset[1] + normal[2] * offset[2];
    let s2 = if l2 > 0.0 { p * p / l2 } else { 0.0 };
    c.powi(32) * 0.01 / (0.01 + s2)
}

fn d(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let c = normal[0] * neighbour[0] + normal[1] * neighbour[1] + normal[2] * neighbour[2];
    let l = (offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]).sqrt();
    let p = normal[0] * offset[0] + normal[1] * offset[1] + normal[2] * offset[2];
    let s = if l > 0.0 { p.abs() / l } else { 0.0 };
    c.max(0.0).powi(32) * 0.01 / (0.01 + s)
}

fn e(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let c = normal[0] * neighbour[0] + normal[1] * neighbour[1] + normal[2] * neighbour[2];
    let l2 = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
    let p = neighbour[0] * offset[0] + neighbour[1] * offset[1] + neighbour[2] * offset[2];
    let s2 = if l2 > 0.0 { p * p / l2 } else { 0.0 };
    c.max(0.0).powi(32) * 0.01 / (0.01 + s2)
}

fn f(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let c = normal[0] * neighbour[0] + normal[1] * neighbour[1] + normal[2] * neighbour[2];
    let l2 = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
    let p = normal[0] * offset[0] + normal[1] * offset[1] + normal[2] * offset[2];
    let s2 = if l2 > 0.0 { p * p / l2 } else { 0.0 };
    (c.max(0.0) * 0.01 / (0.01 + s2)).powi(32)
}

fn second_a(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let cosine = normal[0] * neighbour[0] + normal[1] * neighbour[1] + normal[2] * neighbour[2];
    let s = normal[0] * offset[0] + normal[1] * offset[1] + normal[2] * offset[2];
    cosine.max(0.0).powi(32) * 0.01 / (0.01 + s * s)
}

fn second_b(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let cosine = (normal[0] * neighbour[0] + normal[1] * neighbour[1] + normal[2] * neighbour[2]).max(0.0);
    let squared = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
    let sine_squared = if squared == 0.0 {
        0.0
    } else {
        let dot = normal[0] * offset[0] + normal[1] * offset[1] + normal[2] * offset[2];
        (1.0 - dot * dot / squared).max(0.0)
    };
    cosine.powi(32) * (0.01 / (0.01 + sine_squared))
}

fn second_c(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let cosine = normal[0] * neighbour[0] + normal[1] * neighbour[1] + normal[2] * neighbour[2];
    if cosine <= 0.0 {
        return 0.0;
    }
    let length = (offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]).sqrt();
    let sine = if length > 0.0 {
        ((normal[0] * offset[0] + normal[1] * offset[1] + normal[2] * offset[2]) / length).abs()
    } else {
        0.0
    };
    cosine.powi(32) * 0.01 / (0.01 + sine)
}
