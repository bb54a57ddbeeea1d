use super::Placement;
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

/// A triangle.
///
/// It has two sides and no inside; a ray through an edge counts as a hit.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Triangle {
    /// The vertices, in the entity's space, in scene units; not collinear.
    pub vertices: [DVec3; 3],
    /// Vertex normals in the entity's space, from which shading normals are interpolated; of any length but 0, all on
    /// one side of the triangle.
    ///
    /// Without them the shading normal is the geometric normal.
    #[serde(with = "given", skip_serializing_if = "Option::is_none")]
    pub normals: Option<[DVec3; 3]>,
    /// Texture coordinates of the vertices; without them (0, 0), (1, 0) and (0, 1).
    #[serde(with = "given", skip_serializing_if = "Option::is_none")]
    pub uvs: Option<[DVec2; 3]>,
}

impl Default for Triangle {
    fn default() -> Self {
        Self { vertices: [DVec3::ZERO, DVec3::X, DVec3::Y], normals: None, uvs: None }
    }
}

/// An optional field that is either absent or written as its bare value, without `Some`.
mod given {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    /// Never called with `None`, which the field's `skip_serializing_if` leaves out.
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
