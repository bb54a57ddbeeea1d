//! The exercise of chapter 10; `cargo run --release -- check 10` compares it with pinhole's.

// ANCHOR: reflected_radiance
/// The radiance that a matte surface sends towards the eye from one point light that nothing blocks.
///
/// `colour` is the reflectance, from 0 to 1, and `intensity` is the light's.
/// `position` is the surface's point and `light` the light's, in one space and in scene units; `normal` has length 1.
/// A surface that faces away from the light, or lies in line with it, sends 0; so does a point at the light's own place.
/// The answer may be off by 1e-10 of itself.
pub fn reflected_radiance(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], light: [f64; 3]) -> f64 {
    // Yours to write: put your own lines for the two below.
    let _ = (colour, intensity, position, normal, light);
    -1.0
}
// ANCHOR_END: reflected_radiance
