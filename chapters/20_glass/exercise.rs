//! The exercise of chapter 20; `cargo run --release -- check 20` compares it with pinhole's.

// ANCHOR: refracted
/// The direction in which light goes on that passes through a surface, or `None` where all of it is reflected.
///
/// `direction` and `normal` have length 1, and the normal is on the side that the light comes from.
/// `eta` is the index of refraction of the far side over that of the near side.
/// Each part may be off by 1e-9.
pub fn refracted(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
    // Yours to write: put your own lines for the two below.
    let _ = (direction, normal, eta);
    Some([0.0; 3])
}
// ANCHOR_END: refracted
