//! The exercise of chapter 25; `cargo run --release -- check 25` compares it with pinhole's.

// ANCHOR: after_roulette
/// What a path's throughput in red, green and blue becomes in Russian roulette, by a number from 0 to below 1.
///
/// The path goes on with a probability as large as the largest of the three, but of at most 1; where the number lies
/// below that probability it does. One that goes on must count for those that did not; of one that ends, nothing is left.
pub fn after_roulette(throughput: [f64; 3], u: f64) -> [f64; 3] {
    // Yours to write: put your own lines for the two below.
    let _ = (throughput, u);
    [f64::MAX; 3]
}
// ANCHOR_END: after_roulette
