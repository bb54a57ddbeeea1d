use super::mesh::{Mesh, MeshPart};
use crate::file::spawned;
use crate::{MeshGeometry, MeshInstance};
use bevy_ecs::prelude::*;
use pinhole_models::TriangleMesh;
use std::collections::BTreeMap;

/// A mesh that no file holds, and the entities that are instances of it.
#[derive(Clone, Debug)]
pub struct MeshInMemory {
    /// The triangles.
    pub geometry: MeshGeometry,
    /// The instances, in spawn order.
    pub instances: Vec<Entity>,
    /// The file that [`scene_text`](crate::scene_text) names for it; it is not there unless someone writes it.
    pub file: String,
}

/// The meshes of a scene that were made by a program, in the order in which they are first used.
pub fn meshes_in_memory(scene: &World) -> Vec<MeshInMemory> {
    let mut rows: BTreeMap<*const TriangleMesh, usize> = BTreeMap::new();
    let mut meshes: Vec<MeshInMemory> = Vec::new();
    for entity in spawned(scene) {
        let Some(MeshInstance { geometry }) = entity.get::<MeshInstance>() else { continue };
        if entity.contains::<Mesh>() || entity.contains::<MeshPart>() {
            continue;
        }
        let row = *rows.entry(std::ptr::from_ref(&**geometry)).or_insert_with(|| {
            let file = format!("mesh-{}.glb", meshes.len() + 1);
            meshes.push(MeshInMemory { geometry: geometry.clone(), instances: Vec::new(), file });
            meshes.len() - 1
        });
        meshes[row].instances.push(entity.id());
    }
    meshes
}
