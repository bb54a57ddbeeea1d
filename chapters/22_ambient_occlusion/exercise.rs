//! The exercise of chapter 22; `cargo run --release -- check 22` compares it with pinhole's.

// ANCHOR: cosine_direction
/// The direction about +z that two numbers from 0 to below 1 stand for, a unit vector.
///
/// Directions must be as frequent as their cosine to +z is large. Let `u` be the area of the unit disk that lies nearer to
/// its middle than the direction's foot, as a fraction of the whole, and `v` the turn about +z from +x towards +y, of which 1
/// is a full one.
pub fn cosine_direction(u: f64, v: f64) -> [f64; 3] {
    // Yours to write: put your own lines for the two below.
    let _ = (u, v);
    [f64::MAX; 3]
}
// ANCHOR_END: cosine_direction
