use super::camera::{Camera, CameraRaySlices, ImageFrame, RaySpread, ScreenSlices};
use crate::scene::{OrthographicCamera, SceneError, positive_length};
use glam::{DVec2, DVec3};

/// The orthographic window: its extent on the view plane, for screen points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OrthographicWindow {
    /// Half the window's height, in scene units.
    pub half_height: f64,
}

impl Camera for OrthographicWindow {
    type Component = OrthographicCamera;

    const TABLE: &'static str = "view rectangle";
    const EXTREMES: &'static [OrthographicCamera] =
        &[OrthographicCamera { view_height: 1e-18 }, OrthographicCamera { view_height: 1e18 }];
    const HAS_MANY_ORIGINS: bool = true;

    fn project(component: &OrthographicCamera, _image: ImageFrame, who: &str) -> Result<Self, SceneError> {
        Ok(Self { half_height: positive_length(who, "view_height", component.view_height)? / 2.0 })
    }

    /// Generates rays whose directions are all −z, in the plane z = 0.
    fn generate(&self, screen: ScreenSlices<'_>, rays: CameraRaySlices<'_>) {
        let [ox, oy, _] = rays.origin;
        let [_, _, dz] = rays.direction;
        let rows = screen.x.len();
        let (y, ox, oy, dz) = (&screen.y[..rows], &mut ox[..rows], &mut oy[..rows], &mut dz[..rows]);
        for row in 0..rows {
            let origin = camera_ray_orthographic(DVec2::new(screen.x[row], y[row]), self.half_height);
            (ox[row], oy[row], dz[row]) = (origin.x, origin.y, -1.0);
        }
    }

    fn spread(&self, _image: ImageFrame) -> RaySpread {
        RaySpread::Parallel(self.half_height)
    }

    fn screen_from_camera(&self, point: DVec3) -> Option<DVec2> {
        (point.z < 0.0).then(|| point.truncate() / self.half_height)
    }
}

// ANCHOR: camera_ray_orthographic
/// The origin, in camera space, of the ray through a screen point of an orthographic camera; its direction is −z.
#[inline(always)]
pub fn camera_ray_orthographic(screen: DVec2, half_height: f64) -> DVec3 {
    DVec3::new(screen.x * half_height, screen.y * half_height, 0.0)
}
// ANCHOR_END: camera_ray_orthographic
