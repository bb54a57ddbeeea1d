//! Typical wrong solutions of chapter 08, written as a reader would, and words of the remark that each must get.

use super::question::exercise;
use super::solution::vertical_fov;
use pinhole::scene::FovAxis;
use pinhole_lab::exercise::Exercise;

/// The exercise done.
pub fn solved() -> Exercise {
    exercise(vertical_fov)
}

/// The wrong solutions.
pub fn all() -> Vec<(Exercise, &'static str)> {
    vec![
        (exercise(|a, _, _, _| a), "handed back"),
        (exercise(|a, x, w, h| fov(a, x, w, h, |a, s| a / s)), "tangent of its half"),
        (exercise(in_degrees), "degrees for radians"),
        (exercise(|a, x, w, h| fov(a, x, w, h, right_angle).to_radians()), "in radians"),
        (exercise(|a, x, w, h| fov(a, x, w, h, right_angle) / 2.0), "half the angle"),
        (exercise(full_angle), "full angle"),
    ]
}

fn aspect(width: u32, height: u32) -> f64 {
    f64::from(width) / f64::from(height)
}

fn fov(angle: f64, axis: FovAxis, width: u32, height: u32, vertical: fn(f64, f64) -> f64) -> f64 {
    let aspect = aspect(width, height);
    vertical(
        angle,
        match axis {
            FovAxis::Vertical => 1.0,
            FovAxis::Horizontal => aspect,
            FovAxis::Smaller => aspect.min(1.0),
            FovAxis::Larger => aspect.max(1.0),
            FovAxis::Diagonal => aspect.hypot(1.0),
        },
    )
}

fn right_angle(angle: f64, heights: f64) -> f64 {
    2.0 * ((angle.to_radians() / 2.0).tan() / heights).atan().to_degrees()
}

fn in_degrees(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
    fov(angle, axis, width, height, |angle, heights| 2.0 * ((angle / 2.0).tan() / heights).atan().to_degrees())
}

fn full_angle(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
    fov(angle, axis, width, height, |angle, heights| (angle.to_radians().tan() / heights).atan().to_degrees())
}
