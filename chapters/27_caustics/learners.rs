//! Answers that readers of chapter 27 gave who saw its page and nothing else, and words of the remark that each must get.

use super::question::exercise;
use pinhole_lab::exercise::Exercise;

/// The formula straight from the page.
pub fn textbook() -> Exercise {
    exercise(right)
}

/// What each reader thought, and the answer.
pub fn all() -> Vec<(&'static str, Exercise, &'static str)> {
    vec![
        ("d is how far the point is ahead of the camera, so it is the depth −z", exercise(a), "taken for d"),
        (
            "the image is tan_half high, so a pixel's side is tan_half / height (the 2 forgotten)",
            exercise(b),
            "2 tan_half high",
        ),
        (
            "the plane's area is (2 tan_half)², which belongs to the pixels, and there are `height` of them",
            exercise(c),
            "height² pixels",
        ),
        (
            "light off the axis counts less, so the cosines belong on top, as in the cos⁴ law of lenses",
            exercise(d),
            "multiplied by the cosines",
        ),
        (
            "a cosine must be positive, so I take the absolute value of z and have no need of another test",
            exercise(e),
            "behind the eye",
        ),
        (
            "θ is the angle whose tangent is y / z, as in the field of view (x forgotten, so it is not the angle to the axis)",
            exercise(f),
            "off the axis, of x and y",
        ),
        (
            "The image is 2 tan_half on a side and has `height` pixels, so one pixel's area is the square of that over height.",
            exercise(second_a),
            "there are height² pixels on the",
        ),
        (
            "d times the cosine is the depth −z, so I simplified the distance and the cosines together to the depth cubed.",
            exercise(second_b),
            "is taken for (−z)³",
        ),
        (
            "From photography I know that it is the fourth power of the cosine, and I trusted that more than the page.",
            exercise(second_c),
            "cos⁴ is taken",
        ),
    ]
}

fn right(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    if point[2] >= 0.0 {
        return 0.0;
    }
    let side = 2.0 * tan_half / height;
    let d = (point[0] * point[0] + point[1] * point[1] + point[2] * point[2]).sqrt();
    let cosine = -point[2] / d;
    1.0 / (side * side * d * d * cosine * cosine * cosine)
}

fn a(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    if point[2] >= 0.0 {
        return 0.0;
    }
    let side = 2.0 * tan_half / height;
    let depth = -point[2];
    let cosine = depth / (point[0] * point[0] + point[1] * point[1] + point[2] * point[2]).sqrt();
    1.0 / (side * side * depth * depth * cosine * cosine * cosine)
}

fn b(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    if point[2] >= 0.0 {
        return 0.0;
    }
    let side = tan_half / height;
    let d = (point[0] * point[0] + point[1] * point[1] + point[2] * point[2]).sqrt();
    let cosine = -point[2] / d;
    1.0 / (side * side * d * d * cosine.powi(3))
}

fn c(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    if point[2] >= 0.0 {
        return 0.0;
    }
    let area = (2.0 * tan_half) * (2.0 * tan_half) / height;
    let d = (point[0] * point[0] + point[1] * point[1] + point[2] * point[2]).sqrt();
    let cosine = -point[2] / d;
    1.0 / (area * d * d * cosine.powi(3))
}

fn d(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    if point[2] >= 0.0 {
        return 0.0;
    }
    let side = 2.0 * tan_half / height;
    let d2 = point[0] * point[0] + point[1] * point[1] + point[2] * point[2];
    let cosine = -point[2] / d2.sqrt();
    cosine.powi(3) / (side * side * d2)
}

fn e(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    let side = 2.0 * tan_half / height;
    let d = (point[0] * point[0] + point[1] * point[1] + point[2] * point[2]).sqrt();
    let cosine = point[2].abs() / d;
    1.0 / (side * side * d * d * cosine.powi(3))
}

fn f(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    if point[2] >= 0.0 {
        return 0.0;
    }
    let side = 2.0 * tan_half / height;
    let d2 = point[0] * point[0] + point[1] * point[1] + point[2] * point[2];
    let theta = (point[1] / -point[2]).atan();
    1.0 / (side * side * d2 * theta.cos().powi(3))
}

fn second_a(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    if point[2] >= 0.0 {
        return 0.0;
    }
    let area = (2.0 * tan_half) * (2.0 * tan_half) / height;
    let squared = point[0] * point[0] + point[1] * point[1] + point[2] * point[2];
    let cosine = -point[2] / squared.sqrt();
    1.0 / (area * squared * cosine * cosine * cosine)
}

fn second_b(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    let depth = -point[2];
    if depth <= 0.0 {
        return 0.0;
    }
    let side = 2.0 * tan_half / height;
    1.0 / (side * side * depth * depth * depth)
}

fn second_c(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    if point[2] >= 0.0 {
        return 0.0;
    }
    let side = 2.0 * tan_half / height;
    let squared = point[0] * point[0] + point[1] * point[1] + point[2] * point[2];
    let cosine = -point[2] / squared.sqrt();
    1.0 / (side * side * squared * cosine.powi(4))
}
