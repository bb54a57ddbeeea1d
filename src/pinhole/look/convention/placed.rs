use crate::extract::{CameraAxes, ImageFrame, PerspectiveProjection, camera_entity, eye};
use crate::plan::Census;
use crate::scene::{ChildOf, LookAt, OrthographicCamera, PerspectiveCamera};
use crate::{Error, Result};
use bevy_ecs::prelude::*;
use glam::DMat3;

/// A perspective camera that stands somewhere: all that a description of it in other words must keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedCamera {
    /// Eye, target and up in the world: as the author wrote them, or else a point one unit ahead and the camera's own y.
    pub look: LookAt,
    /// Columns: the camera's x (right), y (up) and z (back) as unit vectors of the world.
    pub world_from_camera: DMat3,
    /// tan(vertical angle / 2).
    pub tan_half_vertical: f64,
    /// The image's shape.
    pub image: ImageFrame,
}

impl PlacedCamera {
    /// The camera of a scene.
    ///
    /// Errors: what a render would be refused for; a camera of parallel rays, which has no field of view.
    pub fn of(scene: &World) -> Result<Self> {
        let scene = &Census::of(scene);
        let camera = camera_entity(scene)?;
        if scene.get::<PerspectiveCamera>(camera).is_none() {
            let orthographic = scene.get::<OrthographicCamera>(camera).is_some();
            let kind = if orthographic { "orthographic" } else { "none" };
            let told = format!("the conventions are those of perspective cameras, and this scene's camera is {kind}");
            return Err(Error::Usage(told));
        }
        let world_from_camera = scene.table::<CameraAxes>()?.world_from_camera;
        let eye = eye(scene)?;
        let derived = LookAt { eye, target: eye - world_from_camera.z_axis, up: world_from_camera.y_axis };
        let written = scene.get::<LookAt>(camera).copied().filter(|_| scene.get::<ChildOf>(camera).is_none());
        Ok(Self {
            look: written.unwrap_or(derived),
            world_from_camera,
            tan_half_vertical: scene.table::<PerspectiveProjection>()?.tan_half_vertical,
            image: *scene.table::<ImageFrame>()?,
        })
    }
}
