//! The exercise of chapter 02; `cargo run --release -- check 2` compares it with pinhole's.

// ANCHOR: unit
/// The vector of length 1 that points where `v` points, or `None` where `v` points nowhere.
///
/// Any finite vector other than 0 has a direction, however long or short it is: parts may be as large as 1e308 and as
/// small as 5e-324. A vector with a part that is NaN or infinite has none.
/// Each part may be off by 1e-15.
pub fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    // Yours to write: put your own lines for the two below.
    let _ = v;
    Some([0.0; 3])
}
// ANCHOR_END: unit
