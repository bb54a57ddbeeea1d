use super::camera::{Camera, CameraRaySlices, ImageFrame, Outline, RaySpread, ScreenSlices, half_extent, wide_enough};
use crate::scene::{Degrees, FisheyeCamera, FovAxis, SceneError, number};
use glam::{DVec2, DVec3};

/// The image circle of a fisheye camera, on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ImageCircle {
    /// Its radius in half heights of the image.
    pub radius: f64,
    /// The angle from the axis at its edge, in radians.
    pub half_angle: f64,
}

impl ImageCircle {
    /// The angle between the rays of neighbouring pixels along the radius, in radians; the same everywhere.
    pub fn pixel(&self, image: ImageFrame) -> f64 {
        self.half_angle / self.radius * 2.0 / f64::from(image.height)
    }
}

impl Camera for ImageCircle {
    type Component = FisheyeCamera;

    const TABLE: &'static str = "image circle";
    const EXTREMES: &'static [FisheyeCamera] = &[
        FisheyeCamera { fov: Degrees(0.015), axis: FovAxis::Smaller },
        FisheyeCamera { fov: Degrees(120.0), axis: FovAxis::Diagonal },
        FisheyeCamera { fov: Degrees(360.0), axis: FovAxis::Larger },
    ];
    const HAS_IMAGE_PLANE: bool = false;
    const OUTLINE: Option<Outline> = Some(Outline { noun: "circle", stage: "Mask the image circle" });

    fn project(component: &FisheyeCamera, image: ImageFrame, who: &str) -> Result<Self, SceneError> {
        let &FisheyeCamera { fov, axis } = component;
        if !(fov.0 > 0.0 && fov.0 <= 360.0) {
            let value = format!("{}°", number(fov.0));
            return Err(SceneError::new(who, "fov", value, "it must lie above 0° and be at most 360°"));
        }
        let circle = Self { radius: half_extent(axis, image.aspect()), half_angle: fov.radians() / 2.0 };
        wide_enough(who, fov, image, circle.pixel(image))?;
        Ok(circle)
    }

    fn generate(&self, screen: ScreenSlices<'_>, rays: CameraRaySlices<'_>) {
        let [dx, dy, dz] = rays.direction;
        for row in 0..screen.x.len() {
            let direction = camera_ray_fisheye(DVec2::new(screen.x[row], screen.y[row]), self);
            (dx[row], dy[row], dz[row]) = (direction.x, direction.y, direction.z);
        }
    }

    fn spread(&self, image: ImageFrame) -> RaySpread {
        RaySpread::Angular(self.pixel(image))
    }

    fn screen_from_camera(&self, point: DVec3) -> Option<DVec2> {
        Some(screen_from_fisheye(point, self)).filter(|&screen| in_image_circle(screen, self))
    }

    #[inline(always)]
    fn is_in_image(&self, screen: DVec2) -> bool {
        in_image_circle(screen, self)
    }
}

// ANCHOR: camera_ray_fisheye
/// The direction of a screen point of an equidistant fisheye: its angle from the axis is proportional to the point's
/// distance from the centre.
///
/// Beyond the edge of the image circle it is the direction of the edge; those pixels are masked later.
#[inline(always)]
pub fn camera_ray_fisheye(screen: DVec2, circle: &ImageCircle) -> DVec3 {
    let distance = screen.length();
    if distance == 0.0 {
        return DVec3::NEG_Z;
    }
    let angle = (distance / circle.radius).min(1.0) * circle.half_angle;
    let (sine, cosine) = libm::sincos(angle);
    DVec3::new(sine * (screen.x / distance), sine * (screen.y / distance), -cosine)
}
// ANCHOR_END: camera_ray_fisheye

/// The screen point at which a fisheye shows a direction: the inverse of `camera_ray_fisheye`.
pub fn screen_from_fisheye(direction: DVec3, circle: &ImageCircle) -> DVec2 {
    let across = libm::hypot(direction.x, direction.y);
    let angle = libm::atan2(across, -direction.z);
    let radial = if across > 0.0 { DVec2::new(direction.x, direction.y) / across } else { DVec2::X };
    radial * (angle / circle.half_angle * circle.radius)
}

/// Whether a screen point is within the image circle of a fisheye camera, edge included.
#[inline(always)]
pub fn in_image_circle(screen: DVec2, circle: &ImageCircle) -> bool {
    screen.length() <= circle.radius
}
