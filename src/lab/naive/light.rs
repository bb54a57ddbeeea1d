//! Highlights and lights as they are often written.

use glam::Vec3;
use std::f64::consts::PI;

// ANCHOR: phong_without_factor
/// The highlight of the first paper (Phong 1975), taken for a BRDF: cosⁿα and no factor.
///
/// The exponent then changes how much light comes back, not only where to: 2π / (n + 2) of it.
#[must_use]
pub fn phong_without_factor(exponent: f64, cosine: f64) -> f64 {
    if cosine > 0.0 { libm::pow(cosine, exponent) } else { 0.0 }
}
// ANCHOR_END: phong_without_factor

// ANCHOR: short_blinn_phong_peak
/// The factor that is often given for Blinn–Phong: it leaves out what lies beyond 45°, and more.
#[must_use]
pub fn short_blinn_phong_peak(exponent: f64) -> f64 {
    (exponent + 8.0) / (8.0 * PI)
}
// ANCHOR_END: short_blinn_phong_peak

/// A highlight in f32, with directions taken for unit vectors.
///
/// They are unit vectors but for their last digit; to the power of a large exponent that digit is everything.
#[must_use]
pub fn highlight_f32(peak: f32, exponent: f32, normal: Vec3, to_light: Vec3, to_eye: Vec3) -> f32 {
    let mirrored = 2.0 * normal.dot(to_light) * normal - to_light;
    peak * libm::powf(mirrored.dot(to_eye), exponent)
}

/// The share of a spot light by cosines, as many programs have it.
///
/// In a narrow cone all cosines are 1 but for their last digits.
#[must_use]
pub fn spot_falloff_by_cosine(cosine: f64, inner: f64, outer: f64) -> f64 {
    let s = ((cosine - outer) / (inner - outer)).clamp(0.0, 1.0);
    s * s * (3.0 - 2.0 * s)
}

/// The same in f32.
#[must_use]
pub fn spot_falloff_by_cosine_f32(cosine: f32, inner: f32, outer: f32) -> f32 {
    let s = ((cosine - outer) / (inner - outer)).clamp(0.0, 1.0);
    s * s * (3.0 - 2.0 * s)
}

/// Where a lamp stands that is to pass for the sun: far off for scenes of the size that its author had in mind.
pub const FAR_LAMP: f32 = 1e6;

/// The irradiance of that lamp, which gives `irradiance` at the origin to what faces it.
#[must_use]
pub fn sun_as_a_far_lamp(irradiance: f32, to_light: Vec3, position: Vec3, normal: Vec3) -> f32 {
    let way = to_light * FAR_LAMP - position;
    let distance_squared = way.length_squared();
    irradiance * FAR_LAMP * FAR_LAMP * normal.dot(way / distance_squared.sqrt()) / distance_squared
}

/// Light and matter in f32 without a second thought: a lamp's irradiance times a highlight.
#[must_use]
pub fn lit_f32(intensity: f32, way: Vec3, normal: Vec3, highlight: f32) -> f32 {
    let distance_squared = way.length_squared();
    let cosine = normal.dot(way / distance_squared.sqrt());
    intensity * cosine / distance_squared * highlight
}
