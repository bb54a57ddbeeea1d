//! The component of a mesh, and the hierarchy that its geometry has, however many instances there are.

use super::mesh_hierarchy::MeshHierarchy;
use super::shape::SceneShape;
use crate::scene::{MeshGeometry, MeshInstance};
use std::sync::Arc;

impl SceneShape for MeshInstance {
    const NAME: &'static str = "MeshInstance";
    const WORD: &'static str = "mesh";

    fn scale(&mut self, by: f64) {
        let mut mesh = (*self.geometry).clone();
        for part in mesh.positions.iter_mut().flatten() {
            *part = (f64::from(*part) * by) as f32;
        }
        self.geometry = MeshGeometry::new(mesh);
    }

    /// An octahedron, and a flat one.
    fn examples() -> Vec<Self> {
        let mut flat = (*MeshGeometry::default()).clone();
        flat.positions.iter_mut().for_each(|[_, y, _]| *y *= 0.25);
        vec![Self::default(), Self { geometry: MeshGeometry::new(flat) }]
    }
}

/// The hierarchy of a mesh, built when the first instance asks for it.
pub(super) fn hierarchy_in(geometry: &MeshGeometry) -> Arc<MeshHierarchy> {
    geometry.once(MeshHierarchy::of)
}

/// Whether a mesh encloses an interior; found out when something first asks for it.
pub(super) fn is_closed(geometry: &MeshGeometry) -> bool {
    hierarchy_in(geometry).is_closed(geometry)
}
