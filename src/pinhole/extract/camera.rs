use super::camera_entity::{camera_kind, named_camera};
use super::check::triple;
use super::pose::world_from_entity;
use crate::cameras::{Camera, ImageFrame, Listed, RaySpread, with_cameras};
use crate::plan::{Census, Table};
use crate::scene::{Layers, Resolution, SceneError};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};

/// How far a camera's axes may be from orthonormal before it is considered scaled.
const ROTATION_TOLERANCE: f64 = 1e-9;
/// The greatest number of pixels along one side.
const LONGEST_SIDE: u32 = 65_536;
/// The greatest number of pixels of a film, whose sums take 28 bytes each.
const MOST_PIXELS: u64 = 1 << 30;

/// The camera's position in world space: the origin of render space.
pub fn eye(scene: &Census<'_>) -> Result<DVec3, SceneError> {
    scene.once(|scene| {
        let (who, camera) = named_camera(scene)?;
        Ok(world_from_entity(scene, &who, camera)?.translation)
    })
}

impl Table for ImageFrame {
    const NAME: &'static str = "image shape";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (who, camera) = named_camera(scene)?;
        let Resolution { width, height } = scene.get::<Resolution>(camera).copied().unwrap_or_default();
        let sides = 1..=LONGEST_SIDE;
        let pixels = u64::from(width) * u64::from(height);
        if !sides.contains(&width) || !sides.contains(&height) || pixels > MOST_PIXELS {
            let accepted = format!(
                "each side must have 1 to {LONGEST_SIDE} pixels, and the image at most {MOST_PIXELS} altogether"
            );
            return Err(SceneError::new(who, "resolution", format!("{width} × {height}"), accepted));
        }
        Ok(Self { width, height })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

macro_rules! tables {
    ($($component:ident($camera:ty) $noun:literal,)+) => {
        $(impl Table for $camera {
            const NAME: &'static str = <Self as Camera>::TABLE;

            fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
                projection(scene)
            }

            fn bytes(&self) -> usize {
                size_of::<Self>()
            }
        })+
    };
}
with_cameras!(tables);

/// The projection of the scene's camera, or the default for a camera of another kind.
fn projection<C: Listed>(scene: &Census<'_>) -> Result<C, SceneError> {
    let (who, camera) = named_camera(scene)?;
    let Some(component) = scene.get::<C::Component>(camera) else { return Ok(C::default()) };
    let projection = C::project(component, *scene.table::<ImageFrame>()?, &who)?;
    match C::OUTLINE {
        Some(outline) if !scene.entities::<With<Layers>>().is_empty() => {
            let (noun, outside) = (C::NAMES.noun, outline.noun);
            let accepted = format!(
                "a {noun} camera has none, for outside its {outside} there is nothing to record: use another kind"
            );
            Err(SceneError::new(who, "layers", "requested", accepted))
        }
        _ => Ok(projection),
    }
}

/// How the rays of the scene's camera change across its image.
pub fn camera_spread(scene: &Census<'_>) -> Result<RaySpread, SceneError> {
    (camera_kind(scene)?.spread)(scene)
}

/// The camera's axes in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraAxes {
    /// Columns: the camera's x (right), y (up) and z (back) axes as unit vectors in world space.
    pub world_from_camera: DMat3,
}

impl Table for CameraAxes {
    const NAME: &'static str = "camera axes";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (who, camera) = named_camera(scene)?;
        let world_from_camera = world_from_entity(scene, &who, camera)?.matrix3;
        let off = world_from_camera.transpose() * world_from_camera - DMat3::IDENTITY;
        let worst = off.to_cols_array().iter().fold(0.0_f64, |worst, part| worst.max(part.abs()));
        let rotation = worst <= ROTATION_TOLERANCE && world_from_camera.determinant() > 0.0;
        if !rotation {
            let lengths = DVec3::from([0, 1, 2].map(|axis| world_from_camera.col(axis).length()));
            let mirrored = if world_from_camera.determinant() < 0.0 { "mirrored, " } else { "" };
            let accepted = "a camera may only be rotated and moved, and no parent may scale or mirror it";
            return Err(SceneError::new(who, "scale", format!("{mirrored}{}", triple(lengths)), accepted));
        }
        Ok(Self { world_from_camera })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}
