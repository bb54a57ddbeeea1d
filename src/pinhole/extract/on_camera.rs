//! Components that mean nothing but on the camera.

use super::camera_entity::camera_of;
use crate::plan::Census;
use crate::scene::{Adaptive, Rasterisation, Resolution, Sampling, SceneError, called};
use bevy_ecs::prelude::*;
use std::sync::Arc;

/// Such components, each with its word in messages, unless a table of their own asks where they are.
const ON_CAMERA: [(&str, fn(&Census<'_>) -> Arc<[Entity]>); 4] = [
    ("resolution", |scene| scene.entities::<With<Resolution>>()),
    ("sampling", |scene| scene.entities::<With<Sampling>>()),
    ("rasterisation", |scene| scene.entities::<With<Rasterisation>>()),
    ("adaptive", |scene| scene.entities::<With<Adaptive>>()),
];

/// Checks that no other entity carries one of them.
pub(super) fn check_on_camera(scene: &Census<'_>) -> Result<(), SceneError> {
    let camera = camera_of(scene)?;
    for (word, carrying) in ON_CAMERA {
        if let Some(&other) = carrying(scene).iter().find(|&&entity| entity != camera) {
            return Err(SceneError::new(called(scene, other), word, "on no camera", "it must be on the camera"));
        }
    }
    Ok(())
}
