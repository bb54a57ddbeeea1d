//! The exercise of chapter 26; `cargo run --release -- check 26` compares it with pinhole's.

// ANCHOR: power_heuristic
/// How much a way counts that was found by the chance of density `own`, where another of density `other` could have found
/// it too: own² / (own² + other²), from 0 to 1.
///
/// Densities may be of any size, such as 1e200 or 1e-200. What the own chance never finds counts 0.
pub fn power_heuristic(own: f64, other: f64) -> f64 {
    // Yours to write: put your own lines for the two below.
    let _ = (own, other);
    f64::MAX
}
// ANCHOR_END: power_heuristic
