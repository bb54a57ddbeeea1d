//! The exercise of chapter 11; `cargo run --release -- check 11` compares it with pinhole's.

// ANCHOR: pinhole_from_theirs
/// A direction that is given in another camera's axes, in pinhole's: x right, y up, z back.
///
/// Their x points right if `x_right` is true, and else left; their y up if `y_up`, and else down; their z ahead if
/// `z_ahead`, and else back. The length stays what it is, and only the exact numbers count.
pub fn pinhole_from_theirs(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
    // Yours to write: put your own lines for the two below.
    let _ = (direction, x_right, y_up, z_ahead);
    [0.5; 3]
}
// ANCHOR_END: pinhole_from_theirs
