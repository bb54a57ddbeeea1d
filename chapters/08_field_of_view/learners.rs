//! Answers that readers of chapter 08 gave who saw its page and nothing else, and words of the remark that each must get.

use super::question::exercise;
use pinhole::scene::FovAxis;
use pinhole_lab::exercise::Exercise;

/// The formula straight from the page.
pub fn textbook() -> Exercise {
    exercise(right)
}

/// What each reader thought, and the answer.
pub fn all() -> Vec<(&'static str, Exercise, &'static str)> {
    vec![
        (
            "an angle across a side twice as long is twice as large, so I divide the angle by how much longer the side is",
            exercise(a),
            "angle itself is divided",
        ),
        (
            "tangents grow in proportion to the side, so tan of the angle over the ratio, and back with the arc tangent",
            exercise(b),
            "taken of the full angle",
        ),
        (
            "the formula with k times the tangent from chapter 8's table turns one angle into the other",
            exercise(c),
            "tangent is multiplied by the aspect",
        ),
        (
            "if the image is wider than high, the smaller angle is measured across the width, because a wide image cuts off above and below",
            exercise(d),
            "larger side are swapped",
        ),
        (
            "the diagonal is Pythagoras of width and height, compared with the width",
            exercise(e),
            "diagonal is compared with the width",
        ),
        (
            "half the side is the sine of half the angle, as for the ball, so sines are in proportion",
            exercise(f),
            "sines are taken",
        ),
        (
            "I had learnt from the exercise that half the diagonal is √2 on the screen, and did not notice that this was for a square image.",
            exercise(second_a),
            "taken to be √2 heights",
        ),
        (
            "'The tangent is as many times larger as the half is longer', so I multiplied by the length across the axis and did not see that I was going the other way.",
            exercise(second_b),
            "the tangent is multiplied by the",
        ),
        (
            "For the smaller side I took the smaller over the larger, for the larger one the larger over the smaller, without asking which of them is the height.",
            exercise(second_c),
            "is always taken for the same one",
        ),
    ]
}

fn right(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
    let aspect = width as f64 / height as f64;
    let k = match axis {
        FovAxis::Vertical => 1.0,
        FovAxis::Horizontal => aspect,
        FovAxis::Smaller => aspect.min(1.0),
        FovAxis::Larger => aspect.max(1.0),
        FovAxis::Diagonal => (1.0 + aspect * aspect).sqrt(),
    };
    let tan = (angle / 2.0).to_radians().tan();
    2.0 * (tan / k).atan().to_degrees()
}

fn a(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
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

fn b(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
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

fn c(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
    let aspect = width as f64 / height as f64;
    let k = match axis {
        FovAxis::Vertical => 1.0,
        FovAxis::Horizontal => aspect,
        FovAxis::Smaller => aspect.min(1.0),
        FovAxis::Larger => aspect.max(1.0),
        FovAxis::Diagonal => (1.0 + aspect * aspect).sqrt(),
    };
    2.0 * (k * (angle / 2.0).to_radians().tan()).atan().to_degrees()
}

fn d(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
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

fn e(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
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

fn f(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
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

fn second_a(angle: f64, axis: pinhole::scene::FovAxis, width: u32, height: u32) -> f64 {
    let aspect = width as f64 / height as f64;
    let k = match axis {
        pinhole::scene::FovAxis::Horizontal => aspect,
        pinhole::scene::FovAxis::Smaller => aspect.min(1.0),
        pinhole::scene::FovAxis::Larger => aspect.max(1.0),
        pinhole::scene::FovAxis::Diagonal => 2.0_f64.sqrt(),
        _ => 1.0,
    };
    let tangent = (angle.to_radians() / 2.0).tan();
    2.0 * (tangent / k).atan().to_degrees()
}

fn second_b(angle: f64, axis: pinhole::scene::FovAxis, width: u32, height: u32) -> f64 {
    let aspect = width as f64 / height as f64;
    let k = match axis {
        pinhole::scene::FovAxis::Horizontal => aspect,
        pinhole::scene::FovAxis::Smaller => aspect.min(1.0),
        pinhole::scene::FovAxis::Larger => aspect.max(1.0),
        pinhole::scene::FovAxis::Diagonal => (1.0 + aspect * aspect).sqrt(),
        _ => 1.0,
    };
    let tangent = (angle.to_radians() / 2.0).tan();
    2.0 * (tangent * k).atan().to_degrees()
}

fn second_c(angle: f64, axis: pinhole::scene::FovAxis, width: u32, height: u32) -> f64 {
    let w = width as f64;
    let h = height as f64;
    let k = match axis {
        pinhole::scene::FovAxis::Horizontal => w / h,
        pinhole::scene::FovAxis::Smaller => w.min(h) / w.max(h),
        pinhole::scene::FovAxis::Larger => w.max(h) / w.min(h),
        pinhole::scene::FovAxis::Diagonal => (w * w + h * h).sqrt() / h,
        _ => 1.0,
    };
    let tangent = (angle.to_radians() / 2.0).tan();
    2.0 * (tangent / k).atan().to_degrees()
}
