//! The exercise of chapter 34; `cargo run --release -- check 34` compares it with plain code.

// ANCHOR: sphere_interval
/// Where the image shows a sphere, from left to right: the ends of that interval on the image plane.
///
/// The eye is at the origin, and the image plane at distance 1 in front of it, from x = −`half` to x = `half`. The
/// sphere's centre is `right` to the right of the eye and `ahead` in front of it, at any height. The eye may be so near
/// that the sphere reaches beside or behind it; a sphere that is wholly behind the eye is not asked for, so `ahead` is
/// greater than −`radius`. What lies beyond an edge of the image is cut off at that edge, also where nothing remains: a
/// sphere to the left of the image is from −`half` to −`half`.
pub fn sphere_interval(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    // Yours to write: put your own lines for the two below.
    let _ = (right, ahead, radius, half);
    [0.0; 2]
}
// ANCHOR_END: sphere_interval
