//! Answers to the exercise of chapter 35: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: Some(exercise(textbook)),
        wrong: [
            (exercise(first), "scene's units"),
            (exercise(second), "face away"),
            (exercise(third), "both factors are raised"),
            (exercise(fourth), "that is the cosine, the part along"),
            (exercise(fifth), "the sine is not squared: at 0.1 the"),
            (exercise(sixth), "Second, the sine is not squared"),
        ],
    }
}

pub fn solution(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cosine = dot(normal, neighbour).max(0.0);
    let fourth = cosine * cosine * cosine * cosine;
    let sixteenth = fourth * fourth * fourth * fourth;
    let alike = sixteenth * sixteenth;
    let length = dot(offset, offset).sqrt();
    if length == 0.0 {
        return alike;
    }
    let sine = dot(normal, offset) / length;
    alike * 0.01 / (0.01 + sine * sine)
}

/// The formula straight from the page.
fn textbook(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let c = normal[0] * neighbour[0] + normal[1] * neighbour[1] + normal[2] * neighbour[2];
    let l = (offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]).sqrt();
    let s = (normal[0] * offset[0] + normal[1] * offset[1] + normal[2] * offset[2]) / l;
    c.max(0.0).powi(32) * 0.01 / (0.01 + s * s)
}

/// S is how far the neighbour lies from the plane, that is normal · offset (not divided by the offset's length).
fn first(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let c = normal[0] * neighbour[0] + normal[1] * neighbour[1] + normal[2] * neighbour[2];
    let s = normal[0] * offset[0] + normal[1] * offset[1] + normal[2] * offset[2];
    c.max(0.0).powi(32) * 0.01 / (0.01 + s * s)
}

/// The 32nd power makes everything beyond 90° vanish by itself (but an even power of −1 is 1).
fn second(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let c = normal[0] * neighbour[0] + normal[1] * neighbour[1] + normal[2] * neighbour[2];
    let l2 = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
    let p = normal[0] * offset[0] + normal[1] * offset[1] + normal[2] * offset[2];
    let s2 = if l2 > 0.0 { p * p / l2 } else { 0.0 };
    c.powi(32) * 0.01 / (0.01 + s2)
}

/// The product of the cosine and the plane's factor, all of it to the 32nd power.
fn third(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let c = normal[0] * neighbour[0] + normal[1] * neighbour[1] + normal[2] * neighbour[2];
    let l2 = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
    let p = normal[0] * offset[0] + normal[1] * offset[1] + normal[2] * offset[2];
    let s2 = if l2 > 0.0 { p * p / l2 } else { 0.0 };
    (c.max(0.0) * 0.01 / (0.01 + s2)).powi(32)
}

/// The dot product of the unit offset with the normal is a cosine, and since a sine is asked for I took 1 minus its
/// square.
fn fourth(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
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

/// I put the sine itself into the second factor, without its sign, and overlooked the square.
fn fifth(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
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

/// The cosine squared for the normals, and the sine as it is for the plane.
fn sixth(normal: [f64; 3], neighbour: [f64; 3], offset: [f64; 3]) -> f64 {
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let length = dot(offset, offset).sqrt();
    let sine = if length > 0.0 { dot(normal, offset).abs() / length } else { 0.0 };
    dot(normal, neighbour).max(0.0).powi(2) * 0.01 / (0.01 + sine)
}
