use super::camera_entity::camera_of;
use super::{CameraAxes, ImageCircle, ImageFrame, OrthographicWindow, PerspectiveProjection, SamplingTable};
use crate::plan::{Census, Table};
use crate::scene::{EquirectangularCamera, FisheyeCamera, OrthographicCamera, SceneError};
use bevy_ecs::prelude::*;
use glam::DVec3;
use std::f64::consts::PI;

/// The least share of a pixel that a sample stands for, however many there are, as in pbrt-v4: neighbouring samples are
/// drawn at random, and so further apart than the pixel's side over the root of their number.
const LEAST_SHARE: f64 = 0.125;

/// How a camera's rays change from one sample to the next: to the right, and down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelSteps {
    /// Of the direction, where the image plane is at distance 1; 0 for parallel rays.
    pub direction: [DVec3; 2],
    /// Of the origin; 0 where all rays start at the eye.
    pub origin: [DVec3; 2],
    /// The direction in which the camera looks, a unit vector.
    pub ahead: DVec3,
    /// How far apart neighbouring rays are, in radians, where the camera has no image plane: about the same everywhere.
    pub angle: Option<f64>,
}

impl Table for PixelSteps {
    const NAME: &'static str = "pixel steps";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (image, axes) = (*scene.table::<ImageFrame>()?, scene.table::<CameraAxes>()?.world_from_camera);
        // A pixel is as wide as it is high, on a screen that is 2 high.
        let share = (1.0 / f64::from(scene.table::<SamplingTable>()?.samples).sqrt()).max(LEAST_SHARE);
        let pixel = 2.0 / f64::from(image.height) * share;
        let steps = |length: f64| [axes.x_axis * length, -axes.y_axis * length];
        let camera = scene.entity(camera_of(scene)?);
        let none = [DVec3::ZERO; 2];
        let (mut direction, mut origin, mut angle) = (none, none, None);
        if camera.contains::<OrthographicCamera>() {
            origin = steps(pixel * scene.table::<OrthographicWindow>()?.half_height);
        } else if camera.contains::<FisheyeCamera>() {
            angle = Some(scene.table::<ImageCircle>()?.pixel(image) * share);
        } else if camera.contains::<EquirectangularCamera>() {
            // At the horizon; towards the poles the step to the right is shorter, and that down stays.
            angle = Some((2.0 * PI / f64::from(image.width)).max(PI / f64::from(image.height)) * share);
        } else {
            direction = steps(pixel * scene.table::<PerspectiveProjection>()?.tan_half_vertical);
        }
        Ok(Self { direction, origin, ahead: -axes.z_axis, angle })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}
