use super::Placement;
use bevy_ecs::prelude::*;
use pinhole_models::TriangleMesh;
use std::any::Any;
use std::ops::Deref;
use std::sync::{Arc, OnceLock};

/// A mesh of triangles.
///
/// It is one shape, however many triangles it has, and any number of entities may have the same geometry.
#[derive(Component, Clone, Debug, Default, PartialEq)]
#[require(Placement)]
pub struct MeshInstance {
    /// The triangles, in the entity's space.
    pub geometry: MeshGeometry,
}

impl MeshInstance {
    /// An instance of a mesh of its own; a clone of it has the same geometry.
    pub fn new(mesh: impl Into<Arc<TriangleMesh>>) -> Self {
        Self { geometry: MeshGeometry::new(mesh) }
    }
}

/// The triangles of a mesh, the same for all of its instances, and what has been computed from them.
///
/// The default is an octahedron of radius 1.
#[derive(Clone, Debug)]
pub struct MeshGeometry(Arc<Kept>);

#[derive(Debug)]
struct Kept {
    mesh: Arc<TriangleMesh>,
    computed: OnceLock<Arc<dyn Any + Send + Sync>>,
}

impl MeshGeometry {
    /// The geometry of a mesh.
    pub fn new(mesh: impl Into<Arc<TriangleMesh>>) -> Self {
        Self(Arc::new(Kept { mesh: mesh.into(), computed: OnceLock::new() }))
    }

    /// The result of a function of the mesh, which is called only the first time; for results of another type than the
    /// first it is called every time.
    pub fn once<A: Any + Send + Sync>(&self, compute: impl Fn(&TriangleMesh) -> A) -> Arc<A> {
        let computed = self.0.computed.get_or_init(|| Arc::new(compute(&self.0.mesh)));
        Arc::clone(computed).downcast().unwrap_or_else(|_| Arc::new(compute(&self.0.mesh)))
    }

    /// Whether both are the same, and not just equal.
    pub fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Deref for MeshGeometry {
    type Target = TriangleMesh;
    fn deref(&self) -> &TriangleMesh {
        &self.0.mesh
    }
}

impl PartialEq for MeshGeometry {
    fn eq(&self, other: &Self) -> bool {
        self.is(other) || self.0.mesh == other.0.mesh
    }
}

impl Default for MeshGeometry {
    fn default() -> Self {
        static OCTAHEDRON: OnceLock<MeshGeometry> = OnceLock::new();
        OCTAHEDRON.get_or_init(|| Self::new(octahedron())).clone()
    }
}

/// A triangle for each octant, its vertices on the axes.
fn octahedron() -> TriangleMesh {
    let positions = [0, 1, 2].into_iter().flat_map(|axis| {
        [1.0, -1.0].map(|side| {
            let mut vertex = [0.0; 3];
            vertex[axis] = side;
            vertex
        })
    });
    let triangle = |octant: u32| {
        let [x, y, z] = [octant & 1, 2 + (octant >> 1 & 1), 4 + (octant >> 2 & 1)];
        if octant.count_ones().is_multiple_of(2) { [x, y, z] } else { [x, z, y] }
    };
    TriangleMesh {
        positions: positions.collect(),
        triangles: (0..8).map(triangle).collect(),
        ..TriangleMesh::default()
    }
}
