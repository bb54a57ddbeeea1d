//! The exercise of chapter 16; `cargo run --release -- check 16` compares it with pinhole's.

// ANCHOR: mean_of_stripes
/// The mean of stripes over what a pixel covers.
///
/// The stripes are 1 over [0, 1), −1 over [1, 2), 1 over [2, 3) and so on, and likewise below 0: stripe n, from n to
/// n + 1, is 1 where n is even.
/// The range has its middle at `x` and is `width` wide, 0 or more; where it is 0, the answer is the stripe at `x`.
/// The answer may be off by 1e-9.
pub fn mean_of_stripes(x: f64, width: f64) -> f64 {
    // Yours to write: put your own lines for the two below.
    let _ = (x, width);
    2.0
}
// ANCHOR_END: mean_of_stripes
