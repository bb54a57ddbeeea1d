//! The exercise of chapter 27; `cargo run --release -- check 27` compares it with pinhole's.

// ANCHOR: pixel_fraction
/// What a pixel gets of each unit of light that a point sends to the eye, per steradian: 1 / (A d² cos³ θ).
///
/// The point is in camera space: the eye at the origin, looking down −z. d is how far the point is, θ how far off the axis.
/// A is the pixel's area on the plane at distance 1, which is 2 `tan_half` high and `height` pixels high; pixels are square.
/// What lies behind the eye reaches no pixel.
pub fn pixel_fraction(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
    // Yours to write: put your own lines for the two below.
    let _ = (point, tan_half, height);
    f64::MAX
}
// ANCHOR_END: pixel_fraction
