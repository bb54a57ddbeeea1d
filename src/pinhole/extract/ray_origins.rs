use super::camera_entity::camera_kind;
use super::lens_evidence;
use crate::plan::{Census, Evidence, Table};
use crate::scene::SceneError;

/// Says by its presence that camera rays start at more than one point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayOrigins;

impl Table for RayOrigins {
    const NAME: &'static str = "ray origins";

    fn extract(_scene: &Census<'_>) -> Result<Self, SceneError> {
        Ok(Self)
    }

    fn bytes(&self) -> usize {
        0
    }
}

/// Evidence that camera rays start at more than one point: on a window or on a lens.
pub fn ray_origins_evidence(scene: &Census<'_>) -> Evidence {
    match camera_kind(scene) {
        Ok(camera) if camera.has_many_origins => Evidence::always("rays that start on a window"),
        _ => lens_evidence(scene),
    }
}
