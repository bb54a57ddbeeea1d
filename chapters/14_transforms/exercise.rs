//! The exercise of chapter 14; `cargo run --release -- check 14` compares it with pinhole's.

// ANCHOR: falling_cosine
/// The cosine of the angle at which light falls on a triangle whose corners have normals, and 0 where none does.
///
/// `geometric` is the triangle's own normal, on either of its sides; `normals` are those of the corners, all three on one
/// side of the triangle, which may be the other. Each has length 1. `weights` are the point's barycentric coordinates, from 0
/// to 1 and together 1. `to_eye` and `to_light` lead from the point to the eye and to the light, each of any length but 0.
/// The triangle is lit on the side on which the eye is. Light from below the triangle counts as none.
pub fn falling_cosine(
    geometric: [f64; 3],
    normals: [[f64; 3]; 3],
    weights: [f64; 3],
    to_eye: [f64; 3],
    to_light: [f64; 3],
) -> f64 {
    // Yours to write: put your own lines for the two below.
    let _ = (geometric, normals, weights, to_eye, to_light);
    -1.0
}
// ANCHOR_END: falling_cosine
