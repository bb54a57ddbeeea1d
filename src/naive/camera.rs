//! Camera rays as the textbooks have them.

use glam::{Mat3, Vec3};

// ANCHOR: naive_viewport_f32
/// The world direction through a pixel's centre, not normalised: a viewport of points in the world,
/// in f32.
///
/// Ray Tracing in One Weekend builds its camera so: the first pixel's place in the world, plus
/// whole steps right and down, minus the eye. Far from the origin the places are rounded to the
/// spacing of f32 there, and the subtraction brings that to light: an eye at 10^5 sees the image in
/// blocks, an eye at 10^7 hardly more than one direction.
#[must_use]
pub fn viewport_f32(eye: Vec3, rotation: Mat3, vertical_degrees: f32, size: [u32; 2], pixel: [u32; 2]) -> Vec3 {
    let [width, height] = size.map(|extent| extent as f32);
    let viewport_height = 2.0 * libm::tanf(vertical_degrees.to_radians() / 2.0);
    let viewport_width = viewport_height * width / height;
    let (right, down) = (rotation.x_axis * viewport_width, -rotation.y_axis * viewport_height);
    let (step_right, step_down) = (right / width, down / height);
    let upper_left = eye - rotation.z_axis - right / 2.0 - down / 2.0;
    let first_pixel = upper_left + (step_right + step_down) / 2.0;
    first_pixel + pixel[0] as f32 * step_right + pixel[1] as f32 * step_down - eye
}
// ANCHOR_END: naive_viewport_f32

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::oracle_camera::ExactCamera;
    use crate::scene::FovAxis;
    use glam::{DMat3, DVec2};

    const SIZE: [u32; 2] = [1024, 768];

    /// The worst error over a row of pixels, and how many directions of the row differ from their
    /// left neighbour.
    fn row_from(eye: Vec3) -> (f64, usize) {
        let camera = ExactCamera::new(SIZE[0], SIZE[1], 40.0, FovAxis::Vertical, DMat3::IDENTITY);
        let direction = |x| viewport_f32(eye, Mat3::IDENTITY, 40.0, SIZE, [x, 300]);
        let error = |x| camera.world_error_in_pixels(direction(x), &camera.raster([x, 300], DVec2::splat(0.5)));
        let worst = (0..SIZE[0]).map(error).fold(0.0, f64::max);
        (worst, (1..SIZE[0]).filter(|x| direction(*x) != direction(x - 1)).count() + 1)
    }

    #[test]
    fn it_is_right_at_the_origin_and_breaks_away_from_it() {
        let (near, all) = row_from(Vec3::ZERO);
        let (away, some) = row_from(Vec3::splat(1e5));
        eprintln!("a row of {} pixels: error {near:.1e} px at 0, {away:.1} px and {some} directions at 1e5", SIZE[0]);
        assert!(near < 1e-3 && all == SIZE[0] as usize);
        assert!(away > 1.0 && some < SIZE[0] as usize / 4);
    }
}
