//! The exercise of chapter 03; `cargo run --release -- check 3` compares it with pinhole's.

// ANCHOR: nearest_sphere_t
/// The smallest t above 0 at which origin + t · direction lies on the sphere, or `None` where there is no such t.
///
/// All in one space and in scene units. The direction is not 0 and may have any length; t counts in that length.
/// The origin may lie outside, inside or on the sphere; a ray that only touches it hits it.
/// Whether the ray hits must be right even for a ray that passes 1e7 radii away from the origin along the sphere's edge
/// (never so close to it that f64 could not tell), and t to seven digits.
pub fn nearest_sphere_t(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    // Yours to write: put your own lines for the two below.
    let _ = (origin, direction, centre, radius);
    Some(-1.0)
}
// ANCHOR_END: nearest_sphere_t
