use super::camera::camera_spread;
use super::{CameraAxes, SamplingTable};
use crate::cameras::{ImageFrame, RaySpread};
use crate::plan::{Census, Table};
use crate::scene::SceneError;
use glam::DVec3;

/// The least fraction of a pixel that a sample stands for, however many samples there are, as in pbrt-v4: neighbouring
/// samples are random, and so farther apart than the pixel's side over the square root of their number.
const MIN_FRACTION: f64 = 0.125;

/// The ray differentials of a camera: how its rays change from one sample to the next, to the right and down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelSteps {
    /// Change of the direction, where the image plane is at distance 1; 0 for parallel rays.
    pub direction: [DVec3; 2],
    /// Change of the origin; 0 where all rays start at the eye.
    pub origin: [DVec3; 2],
    /// The viewing direction, a unit vector.
    pub ahead: DVec3,
    /// The angle between neighbouring rays, in radians, for a camera without an image plane; roughly the same
    /// everywhere.
    pub angle: Option<f64>,
}

impl Table for PixelSteps {
    const NAME: &'static str = "pixel steps";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (image, axes) = (*scene.table::<ImageFrame>()?, scene.table::<CameraAxes>()?.world_from_camera);
        // Pixels are square, on a screen of height 2.
        let fraction = (1.0 / f64::from(scene.table::<SamplingTable>()?.samples).sqrt()).max(MIN_FRACTION);
        let pixel = 2.0 / f64::from(image.height) * fraction;
        let steps = |length: f64| [axes.x_axis * length, -axes.y_axis * length];
        let none = [DVec3::ZERO; 2];
        let (direction, origin, angle) = match camera_spread(scene)? {
            RaySpread::Central(half_height) => (steps(pixel * half_height), none, None),
            RaySpread::Parallel(half_height) => (none, steps(pixel * half_height), None),
            RaySpread::Angular(pixel) => (none, none, Some(pixel * fraction)),
        };
        Ok(Self { direction, origin, ahead: -axes.z_axis, angle })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}
