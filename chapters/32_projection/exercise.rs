//! The exercise of chapter 32; `cargo run --release -- check 32` compares it with pinhole's.

// ANCHOR: raster_from_world
/// Where the image shows a point in front of the camera, in pixels: x to the right and y down, from the upper left corner.
///
/// Point and eye are in world space. The axes are the camera's, as unit vectors of the world: to the right, up, and back,
/// against the view. `tan_half` is the tangent of half the vertical field of view; the image has `size` pixels from left
/// to right and from top to bottom.
pub fn raster_from_world(
    point: [f64; 3],
    eye: [f64; 3],
    axes: [[f64; 3]; 3],
    tan_half: f64,
    size: [u32; 2],
) -> [f64; 2] {
    // Yours to write: put your own lines for the two below.
    let _ = (point, eye, axes, tan_half, size);
    [0.0, 0.0]
}
// ANCHOR_END: raster_from_world
