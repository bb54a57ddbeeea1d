use super::camera::{CameraAxes, eye};
use super::check::{at_most_one, kind_and_name};
use crate::plan::{Census, Evidence, Table};
use crate::scene::{LayerKind, Layers, SceneError};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};

/// The layers that are requested, and the transforms from render space to world and camera space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LayerTable {
    /// The kinds, each once, in the order of a file.
    pub kinds: Vec<LayerKind>,
    /// The origin of render space in world space.
    pub eye: DVec3,
    /// Columns: the camera's x, y and z (back) axes as unit vectors in world space.
    pub world_from_camera: DMat3,
}

impl LayerTable {
    /// The kinds that a scene requests, each once, in the order of a file.
    pub fn kinds_of(scene: &Census<'_>) -> Vec<LayerKind> {
        let found = scene.entities::<With<Layers>>();
        let requested = found.first().and_then(|&entity| scene.get::<Layers>(entity));
        let mut kinds = requested.map(|layers| layers.kinds.clone()).unwrap_or_default();
        kinds.sort();
        kinds.dedup();
        kinds
    }
}

impl Table for LayerTable {
    const NAME: &'static str = "layers";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        if let Some(camera) = at_most_one::<Layers>(scene, "layers", "Layers")?
            && scene.get::<Layers>(camera).is_some_and(|layers| layers.kinds.is_empty())
        {
            let who = kind_and_name(scene, "camera", camera);
            return Err(SceneError::new(who, "kinds", "empty", "it must name at least one layer, such as Position"));
        }
        let world_from_camera = scene.table::<CameraAxes>()?.world_from_camera;
        Ok(Self { kinds: Self::kinds_of(scene), eye: eye(scene)?, world_from_camera })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + self.kinds.len() * size_of::<LayerKind>()
    }
}

/// Evidence that a layer of some kind is requested.
pub fn layer_evidence(scene: &Census<'_>, noun: &str, of_kind: impl Fn(LayerKind) -> bool) -> Evidence {
    Evidence::among::<With<Layers>>(scene, noun, |entity| {
        entity.get::<Layers>().is_some_and(|layers| layers.kinds.iter().any(|&kind| of_kind(kind)))
    })
}
