//! The exercise of chapter 29; `cargo run --release -- check 29` compares it with pinhole's.

// ANCHOR: enters_box
/// Whether a ray is in the box between two corners at any t from 0 to `t_max`.
///
/// `inverse` holds 1 over each component of the ray's direction: where a component is 0 or −0, it is ∞ or −∞, and the ray
/// is always between the two faces or never. `low` holds the smaller coordinates, `high` the larger ones, and both may be
/// equal. Faces, edges and corners belong to the box; the origin may lie outside, inside or on it.
/// `t_max` is above 0 and may be infinite.
pub fn enters_box(origin: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3], t_max: f64) -> bool {
    // Yours to write: put your own lines for the two below.
    let _ = (origin, inverse, low, high, t_max);
    false
}
// ANCHOR_END: enters_box
