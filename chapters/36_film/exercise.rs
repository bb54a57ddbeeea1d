//! The exercise of chapter 36; `cargo run --release -- check 36` compares it with pinhole's.

// ANCHOR: value_between
/// The value at a time between the second and the third of four keys, on the smooth curve through them.
///
/// Key n has the time `times[n]` and the value `values[n]`; the times ascend, at any distances.
/// The curve is a cubic; at either key its slope is that of the straight line between the keys before and after it.
pub fn value_between(times: [f64; 4], values: [f64; 4], time: f64) -> f64 {
    // Yours to write: put your own lines for the two below.
    let _ = (times, values, time);
    0.5
}
// ANCHOR_END: value_between
