//! Rays → the nearest surface.
//!
//! Reads: a ray column ([`WorldRays`], later shadow rays) and the tables of shapes.
//! Writes: [`Hits`], the lists of rows of each kind, and [`Surfaces`].
//! Space: render space. Each kind of shape runs one after the other over the whole tile and narrows the hits; among
//! equal distances the lowest shape number wins, so the order of the kinds does not matter.

mod classify;
mod cuboid;
mod disk;
mod ellipsoid;
mod flat;
mod hits;
mod moving;
mod narrow;
mod plane;
mod rectangle;
mod shading_normal;
mod sphere;
mod surface;
mod triangle;
mod triangle_exact;
mod triangle_surface;
mod uv;
mod wide;
mod wide_flat;

pub use classify::{
    CuboidRows, DiskRows, EllipsoidRows, EmissiveRows, MaterialRows, PlaneRows, RectangleRows, SphereRows,
    TriangleRows, classify_hits, classify_stage,
};
pub use cuboid::{
    cuboid_evidence, cuboid_face, cuboid_stage, cuboid_surface, cuboid_surface_stage, cuboid_t, cuboid_verdict,
    face_of_point, intersect_cuboids,
};
pub use disk::{disk_evidence, disk_stage, disk_surface_stage, disk_t, disk_verdict, intersect_disks};
pub use ellipsoid::{
    ellipsoid_evidence, ellipsoid_stage, ellipsoid_surface, ellipsoid_surface_stage, ellipsoid_t, ellipsoid_verdict,
    intersect_ellipsoids,
};
pub use flat::{Crossing, crossing};
pub use hits::{HitColumn, Hits, NO_SHAPE, RayColumn, RayLanes, shape_evidence, start_hits, start_stage};
pub use moving::{at_rest, intersect_moving, moving_stage, moving_surface_stage};
pub use plane::{intersect_planes, plane_stage, plane_surface_stage, plane_t};
pub use rectangle::{
    intersect_rectangles, rectangle_evidence, rectangle_stage, rectangle_surface_stage, rectangle_t, rectangle_verdict,
};
pub use shading_normal::{
    ShadingNormals, falling_cosine, interpolate_normals, shading_normal, shading_normal_stage, vertex_normal_evidence,
};
pub use sphere::{
    Verdict, intersect_spheres, nearness, sphere_evidence, sphere_stage, sphere_surface_stage, sphere_t, sphere_verdict,
};
pub use surface::{Surface, SurfaceSides, SurfaceUvs, Surfaces, offset_bound, offset_origin, sum_of_parts};
pub use triangle::{
    Edges, Shear, edges, intersect_triangles, longest_axis, triangle_evidence, triangle_stage, triangle_t,
    triangle_verdict,
};
pub use triangle_exact::exact_triangle_t;
pub use triangle_surface::{Meeting, triangle_surface, triangle_surface_stage};
pub use uv::{cuboid_uv, flat_uv, sphere_uv};
pub use wide::{wide_ellipsoid_point, wide_ellipsoid_t, wide_sphere_t};
pub use wide_flat::{wide_cuboid_t, wide_disk_t, wide_rectangle_t};

use crate::plan::Stage;

/// Intersection of camera rays, every kind of shape, up to the surface that was hit.
pub fn stages() -> Vec<Stage> {
    let mut stages = vec![start_stage(), sphere_stage(), ellipsoid_stage(), plane_stage()];
    stages.extend([disk_stage(), rectangle_stage(), cuboid_stage(), classify_stage()]);
    stages.extend([sphere_surface_stage(), ellipsoid_surface_stage(), plane_surface_stage()]);
    stages.extend([disk_surface_stage(), rectangle_surface_stage(), cuboid_surface_stage()]);
    stages.extend([triangle_stage(), triangle_surface_stage(), shading_normal_stage()]);
    stages.extend([moving_stage(), moving_surface_stage()]);
    stages
}
