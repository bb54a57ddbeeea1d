//! The components that are shapes.

use super::Placement;
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole_models::TriangleMesh;
use serde::{Deserialize, Serialize};
use std::any::Any;
use std::ops::Deref;
use std::sync::{Arc, OnceLock};

/// A sphere centred on the entity's position; a non-uniform scale turns it into an ellipsoid.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Sphere {
    /// In scene units, above 0.
    pub radius: f64,
}

impl Default for Sphere {
    fn default() -> Self {
        Self { radius: 1.0 }
    }
}

/// An infinite plane through the entity's position.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Plane {
    /// Perpendicular to the plane, in the entity's space; any length but 0.
    pub normal: DVec3,
}

impl Default for Plane {
    fn default() -> Self {
        Self { normal: DVec3::Y }
    }
}

/// A disk centred on the entity's position, in the entity's xz plane, visible from both sides.
///
/// A non-uniform scale turns it into an ellipse.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Disk {
    /// In scene units, above 0.
    pub radius: f64,
}

impl Default for Disk {
    fn default() -> Self {
        Self { radius: 1.0 }
    }
}

/// A rectangle centred on the entity's position, in the entity's xz plane, visible from both sides.
///
/// Under a parent with non-uniform scale it may become a parallelogram.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Rectangle {
    /// Its extent along the entity's x axis, edge to edge; scene units, above 0.
    pub width: f64,
    /// Its extent along the entity's z axis, edge to edge; scene units, above 0.
    pub depth: f64,
}

impl Default for Rectangle {
    fn default() -> Self {
        Self { width: 2.0, depth: 2.0 }
    }
}

/// A box aligned with the entity's axes and centred on its position.
///
/// Under a parent with non-uniform scale it may become a parallelepiped.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Cuboid {
    /// The edge lengths along the entity's x, y and z axes; scene units, above 0.
    pub size: DVec3,
}

impl Default for Cuboid {
    fn default() -> Self {
        Self { size: DVec3::splat(2.0) }
    }
}

/// A cylinder about the entity's own y axis, centred on its position; a non-uniform scale makes it elliptic.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Cylinder {
    /// In scene units, above 0.
    pub radius: f64,
    /// From end to end, in scene units, above 0.
    pub height: f64,
    /// Whether disks close both ends; without them it is a tube, visible from both sides.
    pub capped: bool,
}

impl Default for Cylinder {
    fn default() -> Self {
        Self { radius: 1.0, height: 2.0, capped: true }
    }
}

// ANCHOR: cone
/// A cone about the entity's own y axis, its apex up; the position is half way between base and apex.
///
/// A non-uniform scale makes it elliptic.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Cone {
    /// Of its base, in scene units, above 0.
    pub radius: f64,
    /// From base to apex, in scene units, above 0.
    pub height: f64,
    /// Whether a disk closes its base; without it the inside is visible from below.
    pub capped: bool,
}

impl Default for Cone {
    fn default() -> Self {
        Self { radius: 1.0, height: 2.0, capped: true }
    }
}
// ANCHOR_END: cone

/// A torus about the entity's own y axis: a tube around a circle about its position.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct Torus {
    /// Of the circle in the middle of the tube, in scene units, above 0.
    pub radius: f64,
    /// The radius of the tube, in scene units, above 0 and less than that of the circle, so that there is a hole.
    pub tube: f64,
}

impl Default for Torus {
    fn default() -> Self {
        Self { radius: 1.0, tube: 0.25 }
    }
}

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
