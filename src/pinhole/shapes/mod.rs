//! Shapes: what a shape is, the shapes there are, and the mathematics of each.
//!
//! Reads: a shape's component and its placement; rays, each by its origin and direction in f64.
//! Gives: the shape in render space, the closest t > 0 with its error bound, the surface there, its bounds, its points
//! as a light.
//! Space: render space, with the axes of world space and the eye at its origin.
//!
//! [`Shape`] is all that the rest of the renderer asks of one; `with_shapes` lists those that implement it, one line each.
//! A further shape is a file of this folder, its lines here, and its component and its word in `scene`.

/// The registered shapes, one line each; a further shape is added with a line, and everything else is generic over it.
///
/// A line holds its name as a kind, the type that implements [`Shape`]($crate::shapes::Shape), its noun for a field, and
/// the noun's plural.
/// The order is that of the stages; it does not affect any picture.
#[doc(hidden)]
#[macro_export]
// ANCHOR: shape_list
macro_rules! with_shapes {
    ($then:ident) => {
        $then! {
            Sphere($crate::shapes::PlacedSphere) sphere "spheres",
            Ellipsoid($crate::shapes::Ellipsoid) ellipsoid "ellipsoids",
            Plane($crate::shapes::PlacedPlane) plane "planes",
            Disk($crate::shapes::PlacedDisk) disk "disks",
            Rectangle($crate::shapes::PlacedRectangle) rectangle "rectangles",
            Cuboid($crate::shapes::Slabs) cuboid "cuboids",
            Cylinder($crate::shapes::PlacedCylinder) cylinder "cylinders",
            Cone($crate::shapes::PlacedCone) cone "cones",
            Torus($crate::shapes::PlacedTorus) torus "tori",
            Triangle($crate::shapes::TriangleRow) triangle "triangles",
            Mesh($crate::shapes::PlacedMesh) mesh "meshes",
        }
    };
}
// ANCHOR_END: shape_list
pub use arithmetic::{
    Arithmetic, Bounded, ExactSum, ExactVector, Precise, dot_of, exact_cross, exact_difference, exact_dot, two_product,
    two_sum,
};
pub use bounds::{Bounds, l1_norm, offset_bound, offset_origin};
pub use double_double::{
    double_double_cuboid_t, double_double_disk_t, double_double_ellipsoid_point, double_double_ellipsoid_t,
    double_double_rectangle_t, double_double_sphere_t,
};
pub use frustum::{EmittingFrustum, Frustum, FrustumShape, PlacedFrustum};
pub use mesh::PlacedMesh;
pub use mesh_traversal::MeshHierarchy;
pub use ray_block::{ClosestHit, ClosestHits, HITS, HitBlock, Intersection, RayHit, RaySlices, SurfacePoint, nearness};
pub(crate) use ray_block::{LANES, RayBlock, vector};
pub use space::{
    Pose, UnitRay, UnitSpace, direction_object_from_world, normal_world_from_object, point_object_from_world,
};
pub use torus::PlacedTorus;
pub use triangle::{TriangleFace, TriangleHit, TriangleRow, exact_triangle_t, placed_normals, triangle_surface};
pub use triangle_edges::{Edges, Shear, edges, longest_axis, triangle_intersection, triangle_t};
pub use uv::{UvSlope, face_axes, most_of, planar_uv, plane_axes, sphere_uv};
pub use with_shapes;

mod arithmetic;
mod bounds;
mod cone;
mod cuboid;
mod cylinder;
mod disk;
mod double_double;
mod ellipsoid;
pub mod emitter;
mod frustum;
mod hierarchy_rows;
mod inside;
mod kind;
mod mesh;
mod mesh_lockstep;
mod mesh_traversal;
mod planar;
mod plane;
mod ray_block;
mod rectangle;
mod registry;
mod shape;
mod space;
mod sphere;
mod torus;
mod triangle;
mod triangle_edges;
mod triangle_filter;
mod uv;

pub use cone::PlacedCone;
pub use cuboid::{Slabs, cuboid_face, cuboid_intersection, cuboid_surface, cuboid_t, cuboid_uv};
pub use cylinder::PlacedCylinder;
pub use disk::{PlacedDisk, disk_intersection, disk_t};
pub use ellipsoid::{Ellipsoid, ellipsoid_intersection, ellipsoid_surface, ellipsoid_t};
pub use hierarchy_rows::{HierarchyRoom, hierarchy_of, keep_closest_counted, keep_closest_of};
pub use inside::stretches_inside;
pub use kind::ShapeKind;
pub use planar::{Crossing, Planar, crossing};
pub use plane::{PlacedPlane, plane_t};
pub use rectangle::{PlacedRectangle, rectangle_intersection, rectangle_t};
pub use registry::{
    AnyShape, CustomShape, Emitter, EmitterVisitor, LeavingPoint, Listed, ShapeVisitor, custom_shape, distance_to,
    leaving_point, pdf_towards, point_on, shape_names, visit_emitter, visit_shapes,
};
pub use shape::{Placed, SceneShape, Shape, ShapeNames};
pub use sphere::{PlacedSphere, sphere_intersection, sphere_t};
