//! Rays → the closest hit and its surface.
//!
//! Reads: a ray column ([`WorldRays`](crate::rays::WorldRays), or shadow rays) and the tables of shapes.
//! Writes: [`Hits`], the lists of rows of each kind, and [`Surfaces`].
//! Space: render space. The kinds of shapes run one after another over the whole tile, and each keeps the closest hits;
//! at equal distances the lowest shape number wins, so the order of the kinds does not affect the result.
//!
//! ```
//! use pinhole::intersect::sphere_intersection;
//! use pinhole::prelude::*;
//!
//! // A ray along −z towards a sphere of radius 1 whose centre is 5 away.
//! let hit = sphere_intersection(DVec3::new(0.0, 0.0, -5.0), DVec3::NEG_Z, 1.0);
//! assert_eq!((hit.t, hit.uncertain), (4.0, false));
//! // Along a tangent rounding decides, and the bound says so: such rays are intersected again in double-double.
//! assert!(sphere_intersection(DVec3::new(1.0, 0.0, -5.0), DVec3::NEG_Z, 1.0).uncertain);
//! ```

mod classify;
mod cuboid;
mod disk;
mod double_double;
mod double_double_planar;
mod ellipsoid;
mod evidence;
mod hits;
mod moving;
mod planar;
mod plane;
mod ray_block;
mod rectangle;
mod rows;
mod shading_normal;
mod sphere;
mod start;
mod surface;
mod triangle;
mod triangle_exact;
mod triangle_surface;
mod uv;
mod view;

#[doc(hidden)]
pub use classify::{classify_hits, classify_stage};
#[doc(hidden)]
pub use cuboid::{
    cuboid_evidence, cuboid_face, cuboid_intersection, cuboid_stage, cuboid_surface, cuboid_surface_stage, cuboid_t,
    face_of_point, intersect_cuboids,
};
#[doc(hidden)]
pub use disk::{disk_evidence, disk_intersection, disk_stage, disk_surface_stage, disk_t, intersect_disks};
#[doc(hidden)]
pub use double_double::{double_double_ellipsoid_point, double_double_ellipsoid_t, double_double_sphere_t};
#[doc(hidden)]
pub use double_double_planar::{double_double_cuboid_t, double_double_disk_t, double_double_rectangle_t};
#[doc(hidden)]
pub use ellipsoid::{
    ellipsoid_evidence, ellipsoid_intersection, ellipsoid_stage, ellipsoid_surface, ellipsoid_surface_stage,
    ellipsoid_t, intersect_ellipsoids,
};
pub use evidence::shape_evidence;
pub use hits::Hits;
#[doc(hidden)]
pub use hits::{HitColumn, NO_SHAPE, RayColumn, RaySlices};
#[doc(hidden)]
pub use moving::{at_rest, intersect_moving, moving_stage, moving_surface_stage};
#[doc(hidden)]
pub use planar::{Crossing, crossing};
#[doc(hidden)]
pub use plane::{intersect_planes, plane_stage, plane_surface_stage, plane_t};
#[doc(hidden)]
pub use ray_block::Intersection;
#[doc(hidden)]
pub use rectangle::{
    intersect_rectangles, rectangle_evidence, rectangle_intersection, rectangle_stage, rectangle_surface_stage,
    rectangle_t,
};
#[doc(hidden)]
pub use rows::{
    CuboidRows, DiskRows, EllipsoidRows, EmissiveRows, MaterialRows, PlaneRows, RectangleRows, SphereRows, TriangleRows,
};
#[doc(hidden)]
pub use shading_normal::{
    ShadingNormals, falling_cosine, interpolate_normals, shading_normal, shading_normal_stage, vertex_normal_evidence,
};
#[doc(hidden)]
pub use sphere::{
    intersect_spheres, nearness, sphere_evidence, sphere_intersection, sphere_stage, sphere_surface_stage, sphere_t,
};
#[doc(hidden)]
pub use start::{start_hits, start_stage};
pub use surface::Surfaces;
#[doc(hidden)]
pub use surface::{Surface, SurfaceSides, SurfaceUvs, l1_norm, offset_bound, offset_origin};
#[doc(hidden)]
pub use triangle::{
    Edges, Shear, edges, intersect_triangles, longest_axis, triangle_evidence, triangle_intersection, triangle_stage,
    triangle_t,
};
#[doc(hidden)]
pub use triangle_exact::exact_triangle_t;
#[doc(hidden)]
pub use triangle_surface::{TriangleHit, triangle_surface, triangle_surface_stage};
#[doc(hidden)]
pub use uv::{cuboid_uv, planar_uv, sphere_uv};
