//! The exercise of chapter 33; `cargo run --release -- check 33` compares it with pinhole's.

// ANCHOR: is_inside_edge
/// Whether a sample is inside an edge of a triangle; it is in the triangle if it is inside all three.
///
/// All coordinates are whole steps of 1/256 of a pixel, x to the right and y down. The inside of an edge is to its right,
/// as seen from `from` to `to`. A sample exactly on the edge is inside if it is a left edge, which goes up, or a top edge,
/// which is level and goes to the right. Coordinates are between −2²⁴ and 2²⁴.
pub fn is_inside_edge(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    // Yours to write: put your own lines for the two below.
    let _ = (from, to, sample);
    false
}
// ANCHOR_END: is_inside_edge
