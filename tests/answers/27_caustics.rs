//! Answers to the exercise of chapter 27: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "2 tan_half high"),
            (exercise(second), "height² pixels"),
            (exercise(third), "behind the eye"),
            (exercise(fourth), "off the axis, of x and y"),
            (exercise(fifth), "is taken for (−z)³"),
            (exercise(sixth), "Second, cos⁴ is taken"),
        ],
    }
}

pub fn solution([x, y, z]: [f64; 3], tan_half: f64, height: f64) -> f64 {
    let depth = -z;
    if depth <= 0.0 {
        return 0.0;
    }
    let side = 2.0 * tan_half / height;
    let distance = (x * x + y * y + z * z).sqrt();
    // With cos θ = depth / d.
    distance / (side * side * depth * depth * depth)
}

/// The image is tan_half high, so a pixel's side is tan_half / height (the 2 forgotten).
fn first(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    if point[2] >= 0.0 {
        return 0.0;
    }
    let side = tan_half / height;
    let d = (point[0] * point[0] + point[1] * point[1] + point[2] * point[2]).sqrt();
    let cosine = -point[2] / d;
    1.0 / (side * side * d * d * cosine.powi(3))
}

/// The plane's area is (2 tan_half)², which belongs to the pixels, and there are `height` of them.
fn second(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    if point[2] >= 0.0 {
        return 0.0;
    }
    let area = (2.0 * tan_half) * (2.0 * tan_half) / height;
    let d = (point[0] * point[0] + point[1] * point[1] + point[2] * point[2]).sqrt();
    let cosine = -point[2] / d;
    1.0 / (area * d * d * cosine.powi(3))
}

/// A cosine must be positive, so I take the absolute value of z and have no need of another test.
fn third(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    let side = 2.0 * tan_half / height;
    let d = (point[0] * point[0] + point[1] * point[1] + point[2] * point[2]).sqrt();
    let cosine = point[2].abs() / d;
    1.0 / (side * side * d * d * cosine.powi(3))
}

/// Θ is the angle whose tangent is y / z, as in the field of view (x forgotten, so it is not the angle to the axis).
fn fourth(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    if point[2] >= 0.0 {
        return 0.0;
    }
    let side = 2.0 * tan_half / height;
    let d2 = point[0] * point[0] + point[1] * point[1] + point[2] * point[2];
    let theta = (point[1] / -point[2]).atan();
    1.0 / (side * side * d2 * theta.cos().powi(3))
}

/// D times the cosine is the depth −z, so I simplified the distance and the cosines together to the depth cubed.
fn fifth(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    let depth = -point[2];
    if depth <= 0.0 {
        return 0.0;
    }
    let side = 2.0 * tan_half / height;
    1.0 / (side * side * depth * depth * depth)
}

/// A pixel has the side A, and light falls off as the fourth power of the cosine.
fn sixth([x, y, z]: [f64; 3], tan_half: f64, height: f64) -> f64 {
    let squared = x * x + y * y + z * z;
    let cosine = -z / squared.sqrt();
    if z < 0.0 { 1.0 / (2.0 * tan_half / height * squared * cosine.powi(4)) } else { 0.0 }
}
