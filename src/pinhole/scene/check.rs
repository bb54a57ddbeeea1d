//! Checks of the numbers that components have in common; each gives the one sentence of an error message.

use super::SceneError;
use glam::DVec3;

/// Lengths beyond this leave no room for squares and sums in f32.
const LARGEST_LENGTH: f64 = 1e18;

/// Checks a point: finite, and with coordinates that render space can represent.
pub fn finite_point(who: &str, field: &'static str, point: DVec3) -> Result<DVec3, SceneError> {
    if point.is_finite() && point.abs().max_element() <= LARGEST_LENGTH {
        Ok(point)
    } else {
        Err(SceneError::new(
            who,
            field,
            triple(point),
            format!("each coordinate must be a finite number of at most {LARGEST_LENGTH:e}"),
        ))
    }
}

/// Checks a length: above 0, and such that render space can represent it.
pub fn positive_length(who: &str, field: &'static str, length: f64) -> Result<f64, SceneError> {
    if (1.0 / LARGEST_LENGTH..=LARGEST_LENGTH).contains(&length) {
        Ok(length)
    } else {
        let accepted = format!("it must be a length from {:e} to {LARGEST_LENGTH:e}", 1.0 / LARGEST_LENGTH);
        Err(SceneError::new(who, field, number(length), accepted))
    }
}

/// Three numbers as an author would write them.
pub fn triple(v: DVec3) -> String {
    format!("({}, {}, {})", number(v.x), number(v.y), number(v.z))
}

/// A number as an author would write it, with an exponent where it would have too many digits to read.
pub fn number(value: f64) -> String {
    let size = value.abs();
    if value.is_finite() && size != 0.0 && !(1e-6..1e9).contains(&size) {
        format!("{value:e}")
    } else {
        value.to_string()
    }
}
