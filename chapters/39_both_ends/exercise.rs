//! The exercise of chapter 39; `cargo run --release -- check 39` compares it with pinhole's.

// ANCHOR: way_weight
/// The weight of the first of four ways to find a path, by the power heuristic: its squared pdf over the sum of the squares
/// of all four.
///
/// Given are three ratios: each way's pdf over that of the way *before it*, p₁/p₀, p₂/p₁ and p₃/p₂.
pub fn way_weight(ratios: [f64; 3]) -> f64 {
    // Yours to write: put your own lines for the two below.
    let _ = ratios;
    f64::MAX
}
// ANCHOR_END: way_weight
