//! The exercise of chapter 37; `cargo run --release -- check 37` compares it with pinhole's.

// ANCHOR: circle
/// The point of the unit circle at a fraction of a full turn from 0 up to 1, anticlockwise from (1, 0): its x and y, right
/// to within 10⁻⁶.
///
/// Use +, −, ·, rounding and selections, and no sine or cosine.
pub fn circle(turn: f64) -> [f64; 2] {
    // Yours to write: put your own lines for the two below.
    let _ = turn;
    [1.0, 0.0]
}
// ANCHOR_END: circle
