//! The exercise of chapter 28; `cargo run --release -- check 28` compares it with pinhole's.

// ANCHOR: ray_in_object_space
/// The ray origin + t · direction in a mesh's object space: its origin and its direction there, such that at each t both
/// rays are at the same place of the mesh.
///
/// The mesh is turned and scaled about its own origin, which then lies at `position`: `axes` are the directions that its
/// x, y and z axes have in the world, each of length 1 and at right angles to the others, and `scale` is how many times
/// longer it is along each of them; no factor is 0.
pub fn ray_in_object_space(
    origin: [f64; 3],
    direction: [f64; 3],
    position: [f64; 3],
    axes: [[f64; 3]; 3],
    scale: [f64; 3],
) -> [[f64; 3]; 2] {
    // Yours to write: put your own lines for the two below.
    let _ = (origin, direction, position, axes, scale);
    [[0.0; 3]; 2]
}
// ANCHOR_END: ray_in_object_space
