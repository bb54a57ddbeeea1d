//! Answers to the exercise of chapter 08: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;
use pinhole::scene::FovAxis;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: None,
        wrong: [
            (exercise(first), "angle itself is divided"),
            (exercise(second), "taken of the full angle"),
            (exercise(third), "larger side are swapped"),
            (exercise(fourth), "diagonal is compared with the width"),
            (exercise(fifth), "sines are taken"),
            (exercise(sixth), "Second, the diagonal is taken to be √2"),
        ],
    }
}

pub fn solution(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
    let (width, height) = (f64::from(width), f64::from(height));
    let along = match axis {
        FovAxis::Vertical => height,
        FovAxis::Horizontal => width,
        FovAxis::Smaller => width.min(height),
        FovAxis::Larger => width.max(height),
        FovAxis::Diagonal => (width * width + height * height).sqrt(),
    };
    let half_height = (angle.to_radians() / 2.0).tan() * height / along;
    2.0 * half_height.atan().to_degrees()
}

/// An angle across a side twice as long is twice as large, so I divide the angle by how much longer the side is.
fn first(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
    let aspect = width as f64 / height as f64;
    let k = match axis {
        FovAxis::Vertical => 1.0,
        FovAxis::Horizontal => aspect,
        FovAxis::Smaller => aspect.min(1.0),
        FovAxis::Larger => aspect.max(1.0),
        FovAxis::Diagonal => (1.0 + aspect * aspect).sqrt(),
    };
    angle / k
}

/// Tangents grow in proportion to the side, so tan of the angle over the ratio, and back with the arc tangent.
fn second(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
    let aspect = width as f64 / height as f64;
    let k = match axis {
        FovAxis::Vertical => 1.0,
        FovAxis::Horizontal => aspect,
        FovAxis::Smaller => aspect.min(1.0),
        FovAxis::Larger => aspect.max(1.0),
        FovAxis::Diagonal => aspect.hypot(1.0),
    };
    (angle.to_radians().tan() / k).atan().to_degrees()
}

/// If the image is wider than high, the smaller angle is measured across the width, because a wide image cuts off
/// above and below.
fn third(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
    let aspect = width as f64 / height as f64;
    let k = match axis {
        FovAxis::Vertical => 1.0,
        FovAxis::Horizontal => aspect,
        FovAxis::Smaller => {
            if width > height {
                aspect
            } else {
                1.0
            }
        }
        FovAxis::Larger => {
            if width > height {
                1.0
            } else {
                aspect
            }
        }
        FovAxis::Diagonal => (1.0 + aspect * aspect).sqrt(),
    };
    let tan = (angle.to_radians() / 2.0).tan();
    2.0 * (tan / k).atan().to_degrees()
}

/// The diagonal is Pythagoras of width and height, compared with the width.
fn fourth(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
    let (w, h) = (width as f64, height as f64);
    let ratio = match axis {
        FovAxis::Vertical => 1.0,
        FovAxis::Horizontal => w / h,
        FovAxis::Smaller => w.min(h) / h,
        FovAxis::Larger => w.max(h) / h,
        FovAxis::Diagonal => (w * w + h * h).sqrt() / w,
    };
    let tan = (angle.to_radians() / 2.0).tan();
    2.0 * (tan / ratio).atan().to_degrees()
}

/// Half the side is the sine of half the angle, as for the ball, so sines are in proportion.
fn fifth(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
    let aspect = width as f64 / height as f64;
    let k = match axis {
        FovAxis::Vertical => 1.0,
        FovAxis::Horizontal => aspect,
        FovAxis::Smaller => aspect.min(1.0),
        FovAxis::Larger => aspect.max(1.0),
        FovAxis::Diagonal => (1.0 + aspect * aspect).sqrt(),
    };
    let sine = (angle / 2.0).to_radians().sin();
    2.0 * (sine / k).min(1.0).asin().to_degrees()
}

/// The tangent of half the angle, over how many heights the axis is long, and back by the arctangent, to degrees.
fn sixth(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
    let aspect = width as f64 / height as f64;
    let heights = match axis {
        FovAxis::Horizontal => aspect,
        FovAxis::Smaller => aspect.min(1.0),
        FovAxis::Larger => aspect.max(1.0),
        FovAxis::Diagonal => 2.0_f64.sqrt(),
        _ => 1.0,
    };
    2.0 * ((angle / 2.0).tan() / heights).atan().to_degrees()
}
