use crate::Placement;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// The meshes of a model file, placed together.
///
/// They have the material of this entity if it has one, and otherwise those of the file; the file's cameras and lights
/// are left out.
#[derive(Component, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Mesh {
    /// A .gltf, .glb, .obj or .ply file; its path is relative to the scene file's folder, or to the current folder if
    /// there is no scene file.
    pub file: String,
    /// Whether materials that the file calls single-sided are not there from behind; if not, both sides are seen.
    pub single_sided: bool,
    /// The animation of a glTF file that a film shows: its name, its number from 0 on, or `all`; the first if this is
    /// empty.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub animation: String,
}

/// An entity that [`load_meshes`](super::load_meshes) made for the mesh file of that one; scene files leave it out.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshPart(pub Entity);

/// What was dropped, replaced or added when model files were read, one sentence each.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct ModelNotes(pub Vec<String>);

/// Why the model file of this entity was not read, as a clause after its value.
#[derive(Component, Clone, Debug, PartialEq, Eq)]
pub struct UnreadMesh(pub String);
