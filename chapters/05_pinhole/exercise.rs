//! The exercise of chapter 05; `cargo run --release -- check 5` compares it with pinhole's.

// ANCHOR: perspective_direction
/// The direction, in camera space and of length 1, from the eye through a screen point.
///
/// The screen has its centre at the origin, x to the right, y up, and reaches from −1 to 1 in height.
/// In camera space the eye is the origin, x points right, y up and z back. The image plane stands at z = −1, and half
/// its height is `tan_half_vertical`, the tangent of half the vertical angle.
/// Each part may be off by 2e-15 of itself.
pub fn perspective_direction(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
    // Yours to write: put your own lines for the two below.
    let _ = (screen, tan_half_vertical);
    [0.0; 3]
}
// ANCHOR_END: perspective_direction
