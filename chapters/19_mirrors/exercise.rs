//! The exercise of chapter 19; `cargo run --release -- check 19` compares it with pinhole's.

// ANCHOR: mirrored
/// The direction in which light goes on that comes along `direction` and hits a mirror.
///
/// `direction` has length 1; `normal` may have any length from 1e-6 to 1e6, and may be on either side of the mirror.
/// Each part may be off by 1e-12.
pub fn mirrored(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    // Yours to write: put your own lines for the two below.
    let _ = (direction, normal);
    [0.0; 3]
}
// ANCHOR_END: mirrored
