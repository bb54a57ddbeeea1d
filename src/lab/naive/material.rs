//! Mirrors, glass and rough metal as they are often written.

use glam::{DVec3, Vec3};
use std::f32::consts::PI;

// ANCHOR: refract_unchecked
/// The refracted direction by the formula, with no thought of where nothing passes: there it takes a negative root.
#[must_use]
pub fn refract_unchecked(direction: DVec3, normal: DVec3, eta: f64) -> DVec3 {
    let cosine = -direction.dot(normal);
    let across = (direction + cosine * normal) / eta;
    across - (1.0 - across.length_squared()).sqrt() * normal
}
// ANCHOR_END: refract_unchecked

// ANCHOR: schlick
/// Schlick's polynomial (1994) for the Fresnel reflectance: cheap, and a fair approximation for a denser medium.
#[must_use]
pub fn schlick(cosine: f64, eta: f64) -> f64 {
    let normal_incidence = (eta - 1.0) / (eta + 1.0);
    let normal_incidence = normal_incidence * normal_incidence;
    let rest = 1.0 - cosine;
    normal_incidence + (1.0 - normal_incidence) * rest * rest * rest * rest * rest
}
// ANCHOR_END: schlick

// ANCHOR: fresnel_by_sines_f32
/// The Fresnel reflectance by way of the sine on the far side, in f32: between two media that are nearly one, the sine of a
/// grazing angle is 1 to the last digit, and all seems reflected.
#[must_use]
pub fn fresnel_by_sines_f32(cosine: f32, eta: f32) -> f32 {
    let sine_squared = (1.0 - cosine * cosine) / (eta * eta);
    if sine_squared >= 1.0 {
        return 1.0;
    }
    let far = (1.0 - sine_squared).sqrt();
    let across = (cosine - eta * far) / (cosine + eta * far);
    let within = (eta * cosine - far) / (eta * cosine + far);
    0.5 * (across * across + within * within)
}
// ANCHOR_END: fresnel_by_sines_f32

// ANCHOR: ggx_d_f32
/// GGX's D as the textbook has it, in f32: for a narrow highlight the bracket is a difference of two numbers near 1.
#[must_use]
pub fn ggx_d_f32(cosine: f32, alpha: f32) -> f32 {
    let square = alpha * alpha;
    let bracket = cosine * cosine * (square - 1.0) + 1.0;
    square / (PI * bracket * bracket)
}
// ANCHOR_END: ggx_d_f32

/// Rough metal without masking: what D sends on, though other bumps stand in the way.
#[must_use]
pub fn ggx_brdf_unmasked(to_light: DVec3, to_eye: DVec3, alpha: f64) -> f64 {
    let half = (to_light + to_eye).normalize();
    pinhole::material::ggx_d(half, alpha) / (4.0 * to_light.z * to_eye.z)
}

/// Two directions across a normal by Frisvad's division (2012), in f32: near −z it divides by what rounding left.
#[must_use]
pub fn frame_by_division_f32(normal: Vec3) -> [Vec3; 2] {
    if normal.z < -0.999_999_9 {
        return [Vec3::NEG_Y, Vec3::NEG_X];
    }
    let a = 1.0 / (1.0 + normal.z);
    let b = -normal.x * normal.y * a;
    let x = Vec3::new(1.0 - normal.x * normal.x * a, b, -normal.x);
    let y = Vec3::new(b, 1.0 - normal.y * normal.y * a, -normal.y);
    [x, y]
}
