use super::SMALLEST_PIXEL;
use super::camera::{ImageFrame, half_extent};
use super::camera_entity::camera_of;
use super::check::{kind_and_name, number};
use crate::plan::{Census, Evidence, Table};
use crate::scene::{FisheyeCamera, Layers, SceneError};
use bevy_ecs::prelude::*;

/// The image circle of a fisheye camera, on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ImageCircle {
    /// Its radius in half heights of the image.
    pub radius: f64,
    /// The angle from the axis at its edge, in radians.
    pub half_angle: f64,
}

impl Table for ImageCircle {
    const NAME: &'static str = "image circle";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let camera = camera_of(scene)?;
        if scene.get::<FisheyeCamera>(camera).is_none() {
            return Ok(Self::default());
        }
        let who = kind_and_name(scene, "camera", camera);
        let image = *scene.table::<ImageFrame>()?;
        let FisheyeCamera { fov, axis } = scene.get::<FisheyeCamera>(camera).copied().unwrap_or_default();
        if !(fov.0 > 0.0 && fov.0 <= 360.0) {
            let value = format!("{}°", number(fov.0));
            return Err(SceneError::new(who, "fov", value, "it must lie above 0° and be at most 360°"));
        }
        let circle = Self { radius: half_extent(axis, image.aspect()), half_angle: fov.radians() / 2.0 };
        let pixel = circle.pixel(image);
        if pixel < SMALLEST_PIXEL {
            let (width, height) = (image.width, image.height);
            let value = format!("{}° over {width} × {height} pixels, {pixel:.1e} rad a pixel", number(fov.0));
            let accepted = format!(
                "a pixel must be at least {SMALLEST_PIXEL:.0e} rad wide for world rays in f32: \
                 widen the angle or take fewer pixels"
            );
            return Err(SceneError::new(who, "fov", value, accepted));
        }
        if !scene.entities::<With<Layers>>().is_empty() {
            let accepted =
                "a fisheye camera has none, for outside its circle there is nothing to record: use another kind";
            return Err(SceneError::new(who, "layers", "requested", accepted));
        }
        Ok(circle)
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

impl ImageCircle {
    /// The angle between the rays of neighbouring pixels along the radius, in radians; the same everywhere.
    pub fn pixel(&self, image: ImageFrame) -> f64 {
        self.half_angle / self.radius * 2.0 / f64::from(image.height)
    }
}

/// Evidence that the camera is a fisheye.
pub fn fisheye_evidence(scene: &Census<'_>) -> Evidence {
    Evidence::of::<FisheyeCamera>(scene, "fisheye camera")
}
