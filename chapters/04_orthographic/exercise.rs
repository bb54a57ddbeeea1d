//! The exercise of chapter 04; `cargo run --release -- check 4` compares it with pinhole's.

// ANCHOR: orthographic_ray
/// The ray, in camera space, of an orthographic camera through a screen point: its origin and its direction.
///
/// The screen has its centre at the origin, x to the right, y up, and reaches from −1 to 1 in height.
/// Camera space has the same axes, z towards the back; the rectangle that the image is stands at z = 0 and is
/// `view_height` scene units high. The direction has length 1.
/// Each part may be off by 1e-15 of itself.
pub fn orthographic_ray(screen: [f64; 2], view_height: f64) -> ([f64; 3], [f64; 3]) {
    // Yours to write: put your own lines for the two below.
    let _ = (screen, view_height);
    ([0.0; 3], [0.0; 3])
}
// ANCHOR_END: orthographic_ray
