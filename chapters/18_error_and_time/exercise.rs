//! The exercise of chapter 18; `cargo run --release -- check 18` compares it with pinhole's.

// ANCHOR: variance_and_bias_squared
/// The variance from run to run of one pixel, and the square of its bias, each estimated without a bias of its own.
///
/// `runs` are the pixel's values in renders of different seeds, and `truth` is what they should be on average.
/// The variance is the sum of squared distances from the runs' own mean over one less than their number.
/// bias² is the mean, over all pairs of two different runs x and y, of (x − truth) · (y − truth); it may be negative.
/// Fewer than two runs tell neither: the answer is `None`.
/// Either number may be off by 1e-9 of the two together.
pub fn variance_and_bias_squared(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    // Yours to write: put your own lines for the two below.
    let _ = (runs, truth);
    Some([-1.0, -1.0])
}
// ANCHOR_END: variance_and_bias_squared
