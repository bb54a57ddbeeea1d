//! The exercise of chapter 23; `cargo run --release -- check 23` compares it with pinhole's.

// ANCHOR: lens_direction
/// The unit direction of a ray that starts at a point of the lens, in camera space.
///
/// The lens lies across the axis at the origin, so its point (x, y) is (x, y, 0); the camera looks down −z.
/// `screen` is a screen point, whose place on the image plane at distance 1 is `screen` times `tan_half_vertical`.
/// The ray must pass where the pinhole's ray through that place hits the plane in focus, `focus_distance` ahead.
pub fn lens_direction(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
    // Yours to write: put your own lines for the two below.
    let _ = (screen, tan_half_vertical, lens, focus_distance);
    [f64::MAX; 3]
}
// ANCHOR_END: lens_direction
