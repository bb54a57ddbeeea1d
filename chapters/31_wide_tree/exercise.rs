//! The exercise of chapter 31; `cargo run --release -- check 31` compares it with pinhole's.

// ANCHOR: entered
/// Which of the eight boxes of a node a ray enters, as a mask: bit 0 is the first box, bit 7 the last.
///
/// The line of the ray is in box i from t = `enters[i]` to t = `leaves[i]`; where it misses the box, it leaves before it
/// enters. The ray itself begins at t = 0, perhaps inside a box. `closest` is the t of its closest hit so far, and
/// infinite before there is one: what begins behind that counts as missed.
pub fn entered(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    // Yours to write: put your own lines for the two below.
    let _ = (enters, leaves, closest);
    0
}
// ANCHOR_END: entered
