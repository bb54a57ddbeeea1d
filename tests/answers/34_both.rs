//! Answers to the exercise of chapter 34: the solution, which is for readers who have done theirs, and six wrong ones
//! with words of the remark that each must get.

use super::Answers;
use super::check::exercise;

pub fn answers() -> Answers {
    Answers {
        solution: exercise(solution),
        textbook: Some(exercise(textbook)),
        wrong: [
            (exercise(first), "box around the sphere"),
            (exercise(second), "not in front of the eye"),
            (exercise(third), "as if it were straight ahead"),
            (exercise(fourth), "to the right is positive"),
            (exercise(fifth), "one end is left outside"),
            (exercise(sixth), "the radius over the distance is the"),
        ],
    }
}

pub fn solution(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    // Seen from above, the sphere is a disk; the tangents from the eye to it have this length, squared.
    let squared = right * right + ahead * ahead - radius * radius;
    if squared <= 0.0 {
        return [-half, half];
    }
    let tangent = squared.sqrt();
    let end = |side: f64| {
        // The direction to the centre, turned until it touches the disk: by the angle whose tangent is radius / tangent.
        let x = right * tangent + side * ahead * radius;
        let z = ahead * tangent - side * right * radius;
        if z > 0.0 { (x / z).clamp(-half, half) } else { side * half }
    };
    [end(-1.0), end(1.0)]
}

/// The formula straight from the page.
fn textbook(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    let distance = (right * right + ahead * ahead).sqrt();
    let middle = right.atan2(ahead);
    let aside = (radius / distance).asin();
    [(middle - aside).tan().clamp(-half, half), (middle + aside).tan().clamp(-half, half)]
}

/// What is nearer looks larger, so I take the disk's ends at the depth of the nearest point, ahead − radius; and the
/// whole image if that is behind.
fn first(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    let depth = ahead - radius;
    if depth <= 0.0 {
        return [-half, half];
    }
    [((right - radius) / depth).clamp(-half, half), ((right + radius) / depth).clamp(-half, half)]
}

/// With the eye inside it fills the image, otherwise the tangents of the two angles say all (an angle beyond 90° has a
/// tangent too).
fn second(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    let distance = (right * right + ahead * ahead).sqrt();
    if distance <= radius {
        return [-half, half];
    }
    let middle = right.atan2(ahead);
    let aside = (radius / distance).asin();
    [(middle - aside).tan().clamp(-half, half), (middle + aside).tan().clamp(-half, half)]
}

/// The centre is seen at right/ahead, and to both sides of it lies the tangent of the ball's angle (tangents added,
/// not angles).
fn third(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    let squared = right * right + ahead * ahead - radius * radius;
    if squared <= 0.0 || ahead <= 0.0 {
        return [-half, half];
    }
    let middle = right / ahead;
    let aside = radius / squared.sqrt();
    [(middle - aside).clamp(-half, half), (middle + aside).clamp(-half, half)]
}

/// The image turns left and right about, as a box with a hole does.
fn fourth(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    solution(-right, ahead, radius, half)
}

/// The left end is cut at the left edge and the right end at the right edge (a ball beside the image then has an end
/// outside of it).
fn fifth(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
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

/// The radius is opposite to the angle and the distance to the centre is beside it, so the angle is the arc tangent of
/// their ratio.
fn sixth(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
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
