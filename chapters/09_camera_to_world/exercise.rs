//! The exercise of chapter 09; `cargo run --release -- check 9` compares it with pinhole's.

// ANCHOR: normal_world_from_object
/// The normal, in world space and of length 1, of a surface whose normal in object space is `normal`.
///
/// `columns` are the three columns of the map from object to world: where it takes the x, the y and the z axis.
/// The map may turn, stretch unevenly, shear and mirror; it never flattens. `normal` has length 1 and points outward,
/// and so must the answer. Each part may be off by 1e-9.
pub fn normal_world_from_object(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
    // Yours to write: put your own lines for the two below.
    let _ = (columns, normal);
    [0.0; 3]
}
// ANCHOR_END: normal_world_from_object
