//! A solution of the exercise of chapter 08; look here when you have done yours.

use pinhole::scene::FovAxis;

pub fn vertical_fov(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
    let (width, height) = (f64::from(width), f64::from(height));
    let along = match axis {
        FovAxis::Vertical => height,
        FovAxis::Horizontal => width,
        FovAxis::Smaller => width.min(height),
        FovAxis::Larger => width.max(height),
        FovAxis::Diagonal => (width * width + height * height).sqrt(),
    };
    let half_height = (angle.to_radians() / 2.0).tan() * height / along;
    2.0 * half_height.atan().to_degrees()
}
