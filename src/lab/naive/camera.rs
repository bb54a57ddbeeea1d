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

/// A point within a pixel, to the right, as one f32: the pixel's number plus a jitter from 0 up to 1.
///
/// At the far end of a wide image f32 has only 256 numbers between two pixels, and a jitter close below 1 is rounded
/// into the next.
#[must_use]
pub fn raster_f32(pixel: u32, jitter: f32) -> f32 {
    pixel as f32 + jitter
}

/// Where the centres of a line's pixels lie from 0 to 1, each found from the last by adding 1 / width in f32.
///
/// Every addition rounds, most of them the same way.
#[must_use]
pub fn stepped_f32(width: u32) -> Vec<f32> {
    let step = 1.0 / width as f32;
    let mut at = step / 2.0;
    let next = |_| {
        let here = at;
        at += step;
        here
    };
    (0..width).map(next).collect()
}

/// A pixel's place from 0 to 1, with the last pixel at 1: the number over width − 1.
///
/// Ray Tracing in One Weekend began so. Corners of the image then lie in the middle of pixels, and an image one pixel
/// wide divides 0 by 0.
#[must_use]
pub fn ndc_over_last(pixel: u32, width: u32) -> f32 {
    pixel as f32 / (width as f32 - 1.0)
}

/// tan(φ / 2) in f32.
///
/// π rounded to f32 is larger than π, so that at 180° the tangent is negative and the image upside down; just below, it
/// is off by thousands of rounding steps.
#[must_use]
pub fn tan_half_f32(degrees: f32) -> f32 {
    libm::tanf(degrees.to_radians() / 2.0)
}

/// The axes of a camera at `eye` that looks at `target`, as the textbooks have them: normalise, cross, cross, in f32.
///
/// There is no direction from a point to itself, and none across the view where up lies along it: both divide by 0.
/// And a square may be too small or too large for f32 where the vector is not.
#[must_use]
pub fn look_at_f32(eye: Vec3, target: Vec3, up: Vec3) -> Mat3 {
    let back = (eye - target) / (eye - target).length();
    let across = up.cross(back);
    let right = across / across.length();
    Mat3::from_cols(right, back.cross(right), back)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::oracle_camera::ExactCamera;
    use glam::{DMat3, DVec2};
    use pinhole::scene::FovAxis;

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

    #[test]
    fn they_are_right_where_it_is_easy() {
        assert_eq!(raster_f32(3, 0.25), 3.25);
        assert_eq!(stepped_f32(4), [0.125, 0.375, 0.625, 0.875]);
        assert_eq!(ndc_over_last(1, 3), 0.5);
        assert!((tan_half_f32(90.0) - 1.0).abs() < 1e-6);
        assert_eq!(look_at_f32(Vec3::Z, Vec3::ZERO, Vec3::Y), Mat3::IDENTITY);
    }

    #[test]
    fn they_break_where_it_is_hard() {
        assert_eq!(raster_f32(65_535, 1.0 - f32::EPSILON), 65_536.0);
        assert!(ndc_over_last(0, 1).is_nan());
        assert!(tan_half_f32(180.0) < 0.0);
        assert!(look_at_f32(Vec3::Z, Vec3::Z, Vec3::Y).is_nan());
        assert!(look_at_f32(Vec3::Z, Vec3::ZERO, Vec3::Z).is_nan());
        assert!(look_at_f32(Vec3::Z * 1e-30, Vec3::ZERO, Vec3::Y) != Mat3::IDENTITY);
    }
}
