//! Area lights as they are often sampled.
//!
//! Directions lead from the lit point to the light; the pdfs are taken for those per unit of solid angle.

use glam::DVec3;

// ANCHOR: forgotten_jacobian
/// The pdf of a point chosen uniformly on an area, taken as it is: 1 / A.
///
/// That is per unit of area, and says nothing of how much sky the area fills.
#[must_use]
pub fn pdf_without_jacobian(area: f64) -> f64 {
    1.0 / area
}
// ANCHOR_END: forgotten_jacobian

// ANCHOR: forgotten_cosine
/// The same with the distance, but as if the light always faced the lit point.
#[must_use]
pub fn pdf_without_cosine(to: DVec3, area: f64) -> f64 {
    to.length_squared() / area
}
// ANCHOR_END: forgotten_cosine

// ANCHOR: versine_by_difference
/// 1 − cos of the half angle of a sphere whose sine squared this is, as it stands in the formula.
///
/// Of a small sphere's nothing is left.
#[must_use]
pub fn versine_by_difference(sine_squared: f64) -> f64 {
    1.0 - (1.0 - sine_squared).sqrt()
}
// ANCHOR_END: versine_by_difference

/// The same in f32.
#[must_use]
pub fn versine_by_difference_f32(sine_squared: f32) -> f32 {
    1.0 - (1.0 - sine_squared).sqrt()
}

/// What a point sampled uniformly on a whole sphere tells of its irradiance for a radiance of 1: nothing where it lies on the
/// side that is turned away.
#[must_use]
pub fn irradiance_by_whole_sphere(axis: DVec3, radius: f64, normal: DVec3, u: [f64; 2]) -> f64 {
    let height = 2.0 * u[0] - 1.0;
    let (sine, cosine) = libm::sincos(std::f64::consts::TAU * u[1]);
    let across = (1.0 - height * height).max(0.0).sqrt();
    let out = DVec3::new(across * cosine, height, across * sine);
    let to = axis + out * radius;
    let direction = to / to.length();
    let [at_light, at_surface] = [-out.dot(direction), normal.dot(direction)].map(|cosine| cosine.max(0.0));
    4.0 * std::f64::consts::PI * radius * radius * at_light * at_surface / to.length_squared()
}
