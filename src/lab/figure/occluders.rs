use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::Result;
use pinhole::extract::{
    CuboidTable, DiskTable, EllipsoidTable, PlaneTable, RectangleTable, SphereTable, TriangleTable,
};
use pinhole::intersect::{cuboid_t, disk_t, ellipsoid_t, plane_t, rectangle_t, sphere_t, triangle_t};
use pinhole::plan::{Census, Table};

/// A scene's shapes, for figures that send rays of their own; the intersection is the kit's.
pub struct Occluders {
    spheres: SphereTable,
    ellipsoids: EllipsoidTable,
    planes: PlaneTable,
    triangles: TriangleTable,
    disks: DiskTable,
    rectangles: RectangleTable,
    cuboids: CuboidTable,
}

impl Occluders {
    /// The shapes of a scene, in render space.
    pub fn of(scene: &World) -> Result<Self> {
        let census = &Census::of(scene);
        Ok(Self {
            spheres: SphereTable::extract(census)?,
            ellipsoids: EllipsoidTable::extract(census)?,
            planes: PlaneTable::extract(census)?,
            triangles: TriangleTable::extract(census)?,
            disks: DiskTable::extract(census)?,
            rectangles: RectangleTable::extract(census)?,
            cuboids: CuboidTable::extract(census)?,
        })
    }

    /// Whether anything is met before `reach`.
    pub fn block(&self, origin: DVec3, direction: DVec3, reach: f64) -> bool {
        let spheres = (0..self.spheres.radius.len())
            .map(|row| sphere_t(origin, direction, self.spheres.centre(row), self.spheres.radius[row]));
        let ellipsoids = self.ellipsoids.ellipsoid.iter().map(|ellipsoid| ellipsoid_t(origin, direction, ellipsoid));
        let planes = self.planes.normal.iter().zip(&self.planes.offset);
        let planes = planes.map(|(&normal, &offset)| plane_t(origin, direction, normal, offset));
        let triangles = self.triangles.triangle.iter().map(|triangle| triangle_t(origin, direction, triangle));
        let disks = self.disks.planar.iter().map(|planar| disk_t(origin, direction, planar));
        let rectangles = self.rectangles.planar.iter().map(|planar| rectangle_t(origin, direction, planar));
        let cuboids = self.cuboids.slabs.iter().map(|slabs| cuboid_t(origin, direction, slabs));
        let round = spheres.chain(ellipsoids);
        round.chain(planes).chain(triangles).chain(disks).chain(rectangles).chain(cuboids).any(|t| t < reach)
    }
}
