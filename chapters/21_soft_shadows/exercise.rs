//! The exercise of chapter 21; `cargo run --release -- check 21` compares it with pinhole's.

// ANCHOR: solid_angle_pdf
/// The pdf of a direction, per unit of solid angle at `from`, where a point is sampled uniformly on a planar light of this
/// area and turns out to be `at`.
///
/// `normal` is the light's unit normal there; both of its sides shine. 0 where the light is seen from its edge.
pub fn solid_angle_pdf(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    // Yours to write: put your own lines for the two below.
    let _ = (from, at, normal, area);
    f64::MAX
}
// ANCHOR_END: solid_angle_pdf
