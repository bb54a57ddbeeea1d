//! The stages of the shapes that the book introduces one by one, by their names.

use super::shape_stages::{intersect_stage, surface_stage};
use crate::plan::Stage;
use crate::shapes::{
    Ellipsoid, PlacedDisk, PlacedMesh, PlacedPlane, PlacedRectangle, PlacedSphere, Slabs, TriangleRow,
};

/// The stage that intersects camera rays with spheres.
pub fn sphere_stage() -> Stage {
    intersect_stage::<PlacedSphere>()
}

/// The stage that fills the surfaces of spheres.
pub fn sphere_surface_stage() -> Stage {
    surface_stage::<PlacedSphere>()
}

/// The stage that intersects camera rays with ellipsoids.
pub fn ellipsoid_stage() -> Stage {
    intersect_stage::<Ellipsoid>()
}

/// The stage that fills the surfaces of ellipsoids.
pub fn ellipsoid_surface_stage() -> Stage {
    surface_stage::<Ellipsoid>()
}

/// The stage that intersects camera rays with planes.
pub fn plane_stage() -> Stage {
    intersect_stage::<PlacedPlane>()
}

/// The stage that fills the surfaces of planes.
pub fn plane_surface_stage() -> Stage {
    surface_stage::<PlacedPlane>()
}

/// The stage that intersects camera rays with disks.
pub fn disk_stage() -> Stage {
    intersect_stage::<PlacedDisk>()
}

/// The stage that fills the surfaces of disks.
pub fn disk_surface_stage() -> Stage {
    surface_stage::<PlacedDisk>()
}

/// The stage that intersects camera rays with rectangles.
pub fn rectangle_stage() -> Stage {
    intersect_stage::<PlacedRectangle>()
}

/// The stage that fills the surfaces of rectangles.
pub fn rectangle_surface_stage() -> Stage {
    surface_stage::<PlacedRectangle>()
}

/// The stage that intersects camera rays with cuboids.
pub fn cuboid_stage() -> Stage {
    intersect_stage::<Slabs>()
}

/// The stage that fills the surfaces of cuboids.
pub fn cuboid_surface_stage() -> Stage {
    surface_stage::<Slabs>()
}

/// The stage that intersects camera rays with triangles.
pub fn triangle_stage() -> Stage {
    intersect_stage::<TriangleRow>()
}

/// The stage that fills the surfaces of triangles.
pub fn triangle_surface_stage() -> Stage {
    surface_stage::<TriangleRow>()
}

/// The stage that intersects camera rays with meshes.
pub fn mesh_stage() -> Stage {
    intersect_stage::<PlacedMesh>()
}

/// The stage that fills the surfaces of meshes.
pub fn mesh_surface_stage() -> Stage {
    surface_stage::<PlacedMesh>()
}
