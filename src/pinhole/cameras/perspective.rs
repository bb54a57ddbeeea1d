use super::camera::{
    Camera, CameraRaySlices, ImageFrame, RaySpread, ScreenSlices, half_extent, tan_half_vertical, wide_enough,
};
use crate::scene::{Degrees, FovAxis, PerspectiveCamera, SceneError, number};
use glam::{DVec2, DVec3};
use multiversion::multiversion;

/// The perspective projection of screen points to the image plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PerspectiveProjection {
    /// Half the image plane's height at distance 1: tan(fov / 2) for the vertical field of view.
    pub tan_half_vertical: f64,
}

impl PerspectiveProjection {
    /// The angle, in radians, subtended by the narrowest pixel of an image of this resolution: the one in a corner.
    pub fn narrowest_pixel(&self, image: ImageFrame) -> f64 {
        let corner = DVec2::new(image.aspect(), 1.0) * self.tan_half_vertical;
        2.0 * self.tan_half_vertical / f64::from(image.height) / (1.0 + corner.length_squared())
    }
}

impl Camera for PerspectiveProjection {
    type Component = PerspectiveCamera;

    const TABLE: &'static str = "pinhole";
    const EXTREMES: &'static [PerspectiveCamera] = &[
        PerspectiveCamera { fov: Degrees(0.015), axis: FovAxis::Smaller },
        PerspectiveCamera { fov: Degrees(90.0), axis: FovAxis::Diagonal },
        PerspectiveCamera { fov: Degrees(179.99), axis: FovAxis::Larger },
    ];

    fn project(component: &PerspectiveCamera, image: ImageFrame, who: &str) -> Result<Self, SceneError> {
        let &PerspectiveCamera { fov, axis } = component;
        if !(fov.0 > 0.0 && fov.0 < 180.0) {
            let value = format!("{}°", number(fov.0));
            return Err(SceneError::new(who, "fov", value, "it must lie strictly between 0° and 180°"));
        }
        let tan_half_vertical = tan_half_vertical(fov, axis, image.aspect());
        wide_enough(who, fov, image, 2.0 * tan_half_vertical / f64::from(image.height))?;
        Ok(Self { tan_half_vertical })
    }

    fn generate(&self, screen: ScreenSlices<'_>, rays: CameraRaySlices<'_>) {
        let [dx, dy, dz] = rays.direction;
        perspective_rows(screen.x, screen.y, self.tan_half_vertical, dx, dy, dz);
    }

    fn spread(&self, _image: ImageFrame) -> RaySpread {
        RaySpread::Central(self.tan_half_vertical)
    }

    fn screen_from_camera(&self, point: DVec3) -> Option<DVec2> {
        let depth = -point.z;
        (depth > 0.0).then(|| point.truncate() / depth / self.tan_half_vertical)
    }
}

// ANCHOR: camera_ray_perspective
/// The direction from the eye at the origin through a screen point on the image plane at z = −1.
#[inline(always)]
pub fn camera_ray_perspective(screen: DVec2, tan_half_vertical: f64) -> DVec3 {
    let point = DVec3::new(screen.x * tan_half_vertical, screen.y * tan_half_vertical, -1.0);
    point / (point.x * point.x + point.y * point.y + 1.0).sqrt()
}
// ANCHOR_END: camera_ray_perspective

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn perspective_rows(x: &[f64], y: &[f64], tan_half_vertical: f64, dx: &mut [f64], dy: &mut [f64], dz: &mut [f64]) {
    let rows = x.len();
    let (y, dx, dy, dz) = (&y[..rows], &mut dx[..rows], &mut dy[..rows], &mut dz[..rows]);
    for row in 0..rows {
        let direction = camera_ray_perspective(DVec2::new(x[row], y[row]), tan_half_vertical);
        (dx[row], dy[row], dz[row]) = (direction.x, direction.y, direction.z);
    }
}

// ANCHOR: angle_across
/// The full angle whose half has this tangent; the inverse of [`tan_half`](super::tan_half).
///
/// Beyond 90° it is computed from the difference to 180°, as there.
pub fn angle_of_tan_half(tangent: f64) -> Degrees {
    let degrees = |radians: f64| radians * (180.0 / std::f64::consts::PI);
    Degrees(if tangent > 1.0 {
        180.0 - degrees(2.0 * libm::atan(1.0 / tangent))
    } else {
        degrees(2.0 * libm::atan(tangent))
    })
}

/// The full field of view along `axis` of this projection in an image of this aspect ratio.
pub fn angle_across(lens: &PerspectiveProjection, axis: FovAxis, aspect: f64) -> Degrees {
    angle_of_tan_half(lens.tan_half_vertical * half_extent(axis, aspect))
}
// ANCHOR_END: angle_across

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cameras::tan_half;

    #[test]
    fn the_centre_looks_straight_ahead_to_the_last_bit() {
        assert_eq!(camera_ray_perspective(DVec2::ZERO, 0.7), DVec3::NEG_Z);
    }

    #[test]
    fn with_a_field_of_view_of_90_degrees_the_edge_is_at_45_degrees() {
        let direction = camera_ray_perspective(DVec2::Y, tan_half(Degrees(90.0)));
        assert!((direction.y + direction.z).abs() < 1e-15 && (direction.length() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_field_of_view_along_an_axis_is_the_angle_along_that_axis() {
        let axes = [FovAxis::Vertical, FovAxis::Horizontal, FovAxis::Smaller, FovAxis::Larger, FovAxis::Diagonal];
        let (mut worst, mut tried) = (0.0_f64, 0);
        for axis in axes {
            for aspect in [1e-4, 0.5, 1.0, 16.0 / 9.0, 1e4] {
                for fov in [1e-4, 0.01, 1.0, 40.0, 60.0, 90.0, 120.0, 179.0, 179.99] {
                    let lens =
                        PerspectiveProjection { tan_half_vertical: tan_half_vertical(Degrees(fov), axis, aspect) };
                    let missing = |angle: f64| angle.min(180.0 - angle);
                    let back = angle_across(&lens, axis, aspect).0;
                    worst = worst.max((missing(back) - missing(fov)).abs() / missing(fov));
                    tried += 1;
                }
            }
        }
        eprintln!("{tried} projections: the angle is recovered within {worst:.1e} of itself");
        assert!(worst < 4.0 * f64::EPSILON);
    }
}
