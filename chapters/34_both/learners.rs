//! Answers that readers of chapter 34 gave who saw its page and nothing else, and words of the remark that each must get.

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
            "what is nearer looks larger, so I take the disk's ends at the depth of the nearest point, ahead − radius; and the whole image if that is behind",
            exercise(a),
            "box around the sphere",
        ),
        (
            "radius and distance are the two short sides of a right triangle, so the angle's tangent is radius / distance",
            exercise(b),
            "sine of the angle",
        ),
        (
            "with the eye inside it fills the image, otherwise the tangents of the two angles say all (an angle beyond 90° has a tangent too)",
            exercise(c),
            "not in front of the eye",
        ),
        (
            "the centre is seen at right/ahead, and to both sides of it lies the tangent of the ball's angle (tangents added, not angles)",
            exercise(d),
            "as if it were straight ahead",
        ),
        (
            "the sine of the ball's half angle is radius over how far it is ahead (depth for distance)",
            exercise(e),
            "how far the centre is ahead",
        ),
        (
            "the left end is cut at the left edge and the right end at the right edge (a ball beside the image then has an end outside of it)",
            exercise(f),
            "one end is left outside",
        ),
        (
            "The centre is at the tangent right/ahead, and the touching line makes an angle of the tangent r over its length with it; I added and subtracted the tangents.",
            exercise(second_a),
            "the two ends are as far from the",
        ),
        (
            "The radius is opposite to the angle and the distance to the centre is beside it, so the angle is the arc tangent of their ratio.",
            exercise(second_b),
            "the radius over the distance is the",
        ),
        (
            "The disk at the centre's depth is too small because the ball comes nearer, so I took the disk at its nearest depth, ahead − radius.",
            exercise(second_c),
            "this is the interval of a box",
        ),
    ]
}

fn right(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    let distance = (right * right + ahead * ahead).sqrt();
    let middle = right.atan2(ahead);
    let aside = (radius / distance).asin();
    [(middle - aside).tan().clamp(-half, half), (middle + aside).tan().clamp(-half, half)]
}

fn a(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    let depth = ahead - radius;
    if depth <= 0.0 {
        return [-half, half];
    }
    [((right - radius) / depth).clamp(-half, half), ((right + radius) / depth).clamp(-half, half)]
}

fn b(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    let distance = (right * right + ahead * ahead).sqrt();
    if distance <= radius {
        return [-half, half];
    }
    let quarter = std::f64::consts::FRAC_PI_2;
    let middle = right.atan2(ahead);
    let aside = (radius / distance).atan();
    let low = if middle - aside <= -quarter { -half } else { (middle - aside).tan() };
    let high = if middle + aside >= quarter { half } else { (middle + aside).tan() };
    [low.clamp(-half, half), high.clamp(-half, half)]
}

fn c(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    let distance = (right * right + ahead * ahead).sqrt();
    if distance <= radius {
        return [-half, half];
    }
    let middle = right.atan2(ahead);
    let aside = (radius / distance).asin();
    [(middle - aside).tan().clamp(-half, half), (middle + aside).tan().clamp(-half, half)]
}

fn d(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    let squared = right * right + ahead * ahead - radius * radius;
    if squared <= 0.0 || ahead <= 0.0 {
        return [-half, half];
    }
    let middle = right / ahead;
    let aside = radius / squared.sqrt();
    [(middle - aside).clamp(-half, half), (middle + aside).clamp(-half, half)]
}

fn e(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    if ahead <= radius {
        return [-half, half];
    }
    let quarter = std::f64::consts::FRAC_PI_2;
    let middle = right.atan2(ahead);
    let aside = (radius / ahead).asin();
    let low = if middle - aside <= -quarter { -half } else { (middle - aside).tan() };
    let high = if middle + aside >= quarter { half } else { (middle + aside).tan() };
    [low.clamp(-half, half), high.clamp(-half, half)]
}

fn f(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    let distance = (right * right + ahead * ahead).sqrt();
    if distance <= radius {
        return [-half, half];
    }
    let quarter = std::f64::consts::FRAC_PI_2;
    let middle = right.atan2(ahead);
    let aside = (radius / distance).asin();
    let low = if middle - aside <= -quarter { -half } else { (middle - aside).tan() };
    let high = if middle + aside >= quarter { half } else { (middle + aside).tan() };
    [low.max(-half), high.min(half)]
}

fn second_a(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    let squared = right * right + ahead * ahead;
    if squared <= radius * radius || ahead <= 0.0 {
        return [-half, half];
    }
    let middle = right / ahead;
    let spread = radius / (squared - radius * radius).sqrt();
    [(middle - spread).clamp(-half, half), (middle + spread).clamp(-half, half)]
}

fn second_b(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    let distance = (right * right + ahead * ahead).sqrt();
    if distance <= radius {
        return [-half, half];
    }
    let middle = right.atan2(ahead);
    let spread = (radius / distance).atan();
    let quarter = std::f64::consts::FRAC_PI_2;
    let project = |angle: f64| {
        if angle <= -quarter {
            -half
        } else if angle >= quarter {
            half
        } else {
            angle.tan().clamp(-half, half)
        }
    };
    [project(middle - spread), project(middle + spread)]
}

fn second_c(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    let nearest = ahead - radius;
    if nearest <= 0.0 {
        return [-half, half];
    }
    let left_end = (right - radius) / nearest;
    let right_end = (right + radius) / nearest;
    [left_end.clamp(-half, half), right_end.clamp(-half, half)]
}
