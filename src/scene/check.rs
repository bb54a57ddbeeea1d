//! Checks of the numbers that components have in common; each gives the one sentence of an error message.

use super::{Rgb, SceneError};
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

/// Checks a colour of light: each component finite and at least 0.
pub fn light_colour(who: &str, field: &'static str, colour: Rgb) -> Result<Rgb, SceneError> {
    colour_within(who, field, colour, f64::from(f32::MAX), "each part must be a finite number from 0 to 3.4e38")
}

/// Checks that each component of a colour lies from 0 to `max`.
pub fn colour_within(who: &str, field: &'static str, colour: Rgb, max: f64, accepted: &str) -> Result<Rgb, SceneError> {
    if colour.to_array().iter().all(|part| (0.0..=max).contains(part)) {
        Ok(colour)
    } else {
        Err(SceneError::new(who, field, triple(colour.to_vec()), accepted))
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
