//! The exercise of chapter 38; `cargo run --release -- check 38` compares it with pinhole's.

// ANCHOR: refractive_index
/// The index of refraction n of a glass at a wavelength in nanometres, by Sellmeier's equation.
///
/// n² = 1 + Σ bᵢ λ² / (λ² − cᵢ), with the wavelength λ in *micrometres*, as catalogues give it: 1000 nm are 1 µm.
pub fn refractive_index(b: [f64; 3], c: [f64; 3], wavelength: f64) -> f64 {
    // Yours to write: put your own lines for the two below.
    let _ = (b, c, wavelength);
    f64::MAX
}
// ANCHOR_END: refractive_index
