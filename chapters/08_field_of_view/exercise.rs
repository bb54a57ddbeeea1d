//! The exercise of chapter 08; `cargo run --release -- check 8` compares it with pinhole's.

use pinhole::scene::FovAxis;

// ANCHOR: vertical_fov
/// The vertical field of view, in degrees, of an image that spans `angle` degrees across `axis`.
///
/// Both are full angles, from edge to edge: of the whole height, the whole width, the smaller or the larger of the two,
/// or from corner to corner (`FovAxis::Diagonal`). Width and height count pixels, which are square.
/// Angles lie between 1e-4° and 179.99°. The answer may be off by 1e-10 of itself.
pub fn vertical_fov(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
    // Yours to write: put your own lines for the two below.
    let _ = (angle, axis, width, height);
    0.0
}
// ANCHOR_END: vertical_fov
