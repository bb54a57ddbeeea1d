use crate::extract::{CameraAxes, ImageFrame, PerspectiveProjection, camera_entity, camera_kind, eye, upward};
use crate::plan::Census;
use crate::scene::{ChildOf, LookAt, PerspectiveCamera};
use crate::{Error, Result};
use bevy_ecs::prelude::*;
use glam::DMat3;

/// A perspective camera and its placement: all that a description in another convention must preserve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedCamera {
    /// Eye, target and up in world space: as the author wrote them (an up that nobody wrote is never along the view), or
    /// else a point one unit ahead and the camera's own y axis.
    pub look: LookAt,
    /// Columns: the camera's x (right), y (up) and z (back) axes as unit vectors in world space.
    pub world_from_camera: DMat3,
    /// tan(fov / 2) for the vertical field of view.
    pub tan_half_vertical: f64,
    /// The image's resolution and aspect ratio.
    pub image: ImageFrame,
}

impl PlacedCamera {
    /// The camera of a scene.
    ///
    /// Errors: whatever a render would refuse, and a camera of another kind.
    pub fn of(scene: &World) -> Result<Self> {
        let scene = &Census::of(scene);
        let camera = camera_entity(scene)?;
        if scene.get::<PerspectiveCamera>(camera).is_none() {
            let kind = camera_kind(scene)?.names.noun;
            let message =
                format!("the conventions are those of perspective cameras, and this scene's camera is {kind}");
            return Err(Error::Usage(message));
        }
        let world_from_camera = scene.table::<CameraAxes>()?.world_from_camera;
        let eye = eye(scene)?;
        let derived = LookAt { eye, target: eye - world_from_camera.z_axis, up: world_from_camera.y_axis };
        let written = scene.get::<LookAt>(camera).copied().filter(|_| scene.get::<ChildOf>(camera).is_none());
        // Other programs refuse an up along the view, whoever wrote it.
        let written = written.map(|look| LookAt { up: upward(&look), ..look });
        Ok(Self {
            look: written.unwrap_or(derived),
            world_from_camera,
            tan_half_vertical: scene.table::<PerspectiveProjection>()?.tan_half_vertical,
            image: *scene.table::<ImageFrame>()?,
        })
    }
}
