//! Following light as first path tracers do.

use std::f64::consts::{FRAC_1_PI, TAU};

// ANCHOR: uniform_direction
/// A direction about +z, uniform over the hemisphere: the height is uniform (Archimedes).
#[must_use]
pub fn uniform_direction([u, v]: [f64; 2]) -> [f64; 3] {
    let radius = (u * (2.0 - u)).sqrt();
    [radius * libm::cos(TAU * v), radius * libm::sin(TAU * v), 1.0 - u]
}
// ANCHOR_END: uniform_direction

/// The weight of a uniformly sampled direction of this cosine at a matte surface of this albedo: BRDF times cosine over
/// the uniform pdf.
#[must_use]
pub fn uniform_weight(albedo: f64, cosine: f64) -> f64 {
    albedo * FRAC_1_PI * cosine * TAU
}

/// The same without the cosine: each direction counts as if it were at normal incidence.
#[must_use]
pub fn weight_without_cosine(albedo: f64) -> f64 {
    albedo * FRAC_1_PI * TAU
}

/// The weight of a cosine-sampled direction with the albedo in place of the BRDF: π is forgotten.
#[must_use]
pub fn weight_without_pi(albedo: f64) -> f64 {
    albedo / FRAC_1_PI
}

// ANCHOR: power_heuristic_f32
/// p² / (p² + q²) in f32: squares of numbers above 2⁶⁴ are infinite, and those of numbers below 2⁻⁷⁵ are 0.
#[must_use]
pub fn power_heuristic_f32(own: f32, other: f32) -> f32 {
    own * own / (own * own + other * other)
}
// ANCHOR_END: power_heuristic_f32

// ANCHOR: light_of_capped_path
/// The radiance that a path carries in a closed room whose walls emit 1 and have this albedo, cut off at this depth.
#[must_use]
pub fn light_of_capped_path(albedo: f64, max_depth: u32) -> f64 {
    let (mut light, mut throughput) = (0.0, 1.0);
    for _ in 0..max_depth {
        light += throughput;
        throughput *= albedo;
    }
    light
}
// ANCHOR_END: light_of_capped_path
