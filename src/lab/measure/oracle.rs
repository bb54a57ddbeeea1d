//! The exact oracle of every registered shape: the distance with more precision than any method has.

use super::ray_aim::AimedRay;
use super::{
    oracle_cuboid, oracle_disk, oracle_ellipsoid, oracle_frustum, oracle_plane, oracle_rectangle, oracle_sphere,
    oracle_torus, oracle_triangle,
};
use pinhole::shapes::{
    Ellipsoid, FrustumShape, Listed, PlacedDisk, PlacedFrustum, PlacedPlane, PlacedRectangle, PlacedSphere,
    PlacedTorus, Slabs, TriangleRow,
};

/// A shape whose intersections are known exactly.
pub trait Oracle: Listed {
    /// The smallest t > 0 at which a ray intersects it, if any, rounded to f64 once.
    fn exact_t(&self, ray: AimedRay) -> Option<f64>;
}

impl Oracle for PlacedSphere {
    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        let &Self { centre, radius } = self;
        oracle_sphere::sphere_t(origin, direction, oracle_sphere::Sphere { centre, radius })
    }
}

impl Oracle for Ellipsoid {
    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        oracle_ellipsoid::ellipsoid_t(origin, direction, self)
    }
}

impl Oracle for PlacedPlane {
    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        let &Self { normal, offset } = self;
        oracle_plane::plane_t(origin, direction, oracle_plane::Plane { normal, offset })
    }
}

impl Oracle for PlacedDisk {
    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        oracle_disk::disk_t(origin, direction, &self.planar)
    }
}

impl Oracle for PlacedRectangle {
    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        oracle_rectangle::rectangle_t(origin, direction, &self.planar)
    }
}

impl Oracle for Slabs {
    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        oracle_cuboid::cuboid_t(origin, direction, self).map(|(t, _)| t)
    }
}

impl Oracle for TriangleRow {
    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        oracle_triangle::triangle_t(origin, direction, self.corners)
    }
}

impl<C: FrustumShape> Oracle for PlacedFrustum<C>
where
    Self: Listed,
{
    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        oracle_frustum::frustum_t(origin, direction, &self.frustum)
    }
}

impl Oracle for PlacedTorus {
    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        oracle_torus::torus_t(origin, direction, self)
    }
}
