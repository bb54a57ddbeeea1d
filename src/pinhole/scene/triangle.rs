use super::Placement;
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

/// A flat piece between three corners.
///
/// It has two sides and no inside; a ray on an edge counts as meeting it.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Triangle {
    /// The corners, in the entity's space, in scene units; not on one line.
    pub vertices: [DVec3; 3],
    /// A normal a corner, in the entity's space, for light that falls as on a bent surface; any length but 0, all on one
    /// side of the triangle.
    ///
    /// Without them light falls as the triangle lies.
    #[serde(with = "given", skip_serializing_if = "Option::is_none")]
    pub normals: Option<[DVec3; 3]>,
    /// Texture coordinates a corner; without them (0, 0), (1, 0) and (0, 1).
    #[serde(with = "given", skip_serializing_if = "Option::is_none")]
    pub uvs: Option<[DVec2; 3]>,
}

impl Default for Triangle {
    fn default() -> Self {
        Self { vertices: [DVec3::ZERO, DVec3::X, DVec3::Y], normals: None, uvs: None }
    }
}

/// A field that is either not there or there as it is, without a word around it.
mod given {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    /// What is not there is skipped before it comes here.
    pub fn serialize<T: Serialize, S: Serializer>(value: &Option<T>, serializer: S) -> Result<S::Ok, S::Error> {
        match value {
            Some(value) => value.serialize(serializer),
            None => serializer.serialize_none(),
        }
    }

    pub fn deserialize<'de, T: Deserialize<'de>, D: Deserializer<'de>>(reader: D) -> Result<Option<T>, D::Error> {
        T::deserialize(reader).map(Some)
    }
}
