use super::camera_entity::{camera_kind, named_camera};
use super::check::triple;
use super::pose::world_from_entity;
use crate::cameras::{Camera, ImageFrame, Listed, RaySpread, with_cameras};
use crate::plan::{Census, Table};
use crate::scene::{ChildOf, Layers, Placement, Resolution, SceneError, called};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};

/// How far a camera's axes may be from orthonormal before it is considered scaled.
const ROTATION_TOLERANCE: f64 = 1e-9;
/// The greatest number of pixels along one side.
const LONGEST_SIDE: u32 = 65_536;
/// The greatest number of pixels of a film, whose sums take 28 bytes each.
const MAX_PIXELS: u64 = 1 << 30;

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
        if !sides.contains(&width) || !sides.contains(&height) || pixels > MAX_PIXELS {
            let accepted = format!(
                "each side must have 1 to {LONGEST_SIDE} pixels, and the image at most {MAX_PIXELS} altogether"
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
            return Err(scaled(scene, who, camera));
        }
        Ok(Self { world_from_camera })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// The error about the first entity from a camera up to its root that scales or mirrors it.
fn scaled(scene: &Census<'_>, who: String, camera: Entity) -> SceneError {
    let accepted = "a camera may only be rotated and moved, and no parent may scale or mirror it";
    let mut chain: Vec<(String, Entity)> = vec![(who.clone(), camera)];
    while let Some(parent) = scene.get::<ChildOf>(chain[chain.len() - 1].1).map(ChildOf::parent) {
        chain.push((format!("{who}'s parent {}", called(scene, parent)), parent));
    }
    let scale = |entity: Entity| scene.get::<Placement>(entity).map_or(DVec3::ONE, |placement| placement.scale);
    let scales =
        |(_, entity): &&(String, Entity)| (scale(*entity) - DVec3::ONE).abs().max_element() > ROTATION_TOLERANCE;
    let (who, entity) = chain.iter().find(scales).unwrap_or(&chain[0]);
    let scale = scale(*entity);
    let mirrors = if scale.x * scale.y * scale.z < 0.0 { ", which mirrors" } else { "" };
    SceneError::new(who.as_str(), "scale", format!("{}{mirrors}", triple(scale)), accepted)
}
