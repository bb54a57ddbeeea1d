//! The exercise of chapter 15; `cargo run --release -- check 15` compares it with pinhole's.

// ANCHOR: phong_radiance
/// The radiance that a Phong surface sends towards the eye of parallel light that nothing blocks.
///
/// `colour` and `specular` are reflectances from 0 to 1, and `exponent` is at least 0.
/// `irradiance` is what a surface that the light falls on at normal incidence would receive.
/// `normal`, `to_light` and `to_eye` have length 1; the eye is on the normal's side.
/// A surface that faces away from the light, or lies in line with it, sends 0.
/// The answer may be off by 1e-10 of itself.
pub fn phong_radiance(
    [colour, specular, exponent]: [f64; 3],
    irradiance: f64,
    normal: [f64; 3],
    to_light: [f64; 3],
    to_eye: [f64; 3],
) -> f64 {
    // Yours to write: put your own lines for the two below.
    let _ = (colour, specular, exponent, irradiance, normal, to_light, to_eye);
    -1.0
}
// ANCHOR_END: phong_radiance
