use super::camera::{Camera, CameraRaySlices, ImageFrame, RaySpread, ScreenSlices};
use crate::scene::{EquirectangularCamera, SceneError};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// The image of an equirectangular camera, on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EquirectangularImage {
    /// The screen's half width, where the longitude is 180°.
    pub aspect: f64,
}

impl Camera for EquirectangularImage {
    type Component = EquirectangularCamera;

    const TABLE: &'static str = "equirectangular image";
    const EXTREMES: &'static [EquirectangularCamera] = &[EquirectangularCamera];
    const HAS_IMAGE_PLANE: bool = false;

    fn project(_component: &EquirectangularCamera, image: ImageFrame, _who: &str) -> Result<Self, SceneError> {
        Ok(Self { aspect: image.aspect() })
    }

    fn generate(&self, screen: ScreenSlices<'_>, rays: CameraRaySlices<'_>) {
        let [dx, dy, dz] = rays.direction;
        for row in 0..screen.x.len() {
            let direction = camera_ray_equirectangular(DVec2::new(screen.x[row], screen.y[row]), self.aspect);
            (dx[row], dy[row], dz[row]) = (direction.x, direction.y, direction.z);
        }
    }

    /// The angle is that at the horizon; towards the poles the step to the right becomes shorter, while that down stays
    /// the same.
    fn spread(&self, image: ImageFrame) -> RaySpread {
        RaySpread::Angular((2.0 * PI / f64::from(image.width)).max(PI / f64::from(image.height)))
    }

    fn screen_from_camera(&self, point: DVec3) -> Option<DVec2> {
        Some(screen_from_equirectangular(point, self.aspect))
    }
}

// ANCHOR: camera_ray_equirectangular
/// The direction of a screen point of an equirectangular image: x is the longitude, y the latitude.
///
/// A point beyond the upper or the lower edge, where wide filters place some, lies beyond the pole.
#[inline(always)]
pub fn camera_ray_equirectangular(screen: DVec2, aspect: f64) -> DVec3 {
    let (sine, cosine) = libm::sincos(screen.x / aspect * PI);
    let (up, across) = libm::sincos(screen.y * (PI / 2.0));
    DVec3::new(across * sine, up, -across * cosine)
}
// ANCHOR_END: camera_ray_equirectangular

/// The screen point at which an equirectangular image shows a direction: the inverse of `camera_ray_equirectangular`.
pub fn screen_from_equirectangular(direction: DVec3, aspect: f64) -> DVec2 {
    let longitude = libm::atan2(direction.x, -direction.z);
    let latitude = libm::atan2(direction.y, libm::hypot(direction.x, direction.z));
    DVec2::new(longitude / PI * aspect, latitude / (PI / 2.0))
}
