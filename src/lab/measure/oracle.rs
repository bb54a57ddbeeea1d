//! The exact oracle of every registered shape: the distance with more precision than any method has, and the side on
//! which a point lies.

use super::draws::Draws;
use super::enclosure::Enclosure;
use super::exact::Dyadic;
use super::exact_vector::{ExactVector, angles};
use super::naive_hits::{self, NaiveHit, NaiveNormal};
use super::number::Number;
use super::ray_aim::AimedRay;
use super::{
    oracle_cuboid, oracle_disk, oracle_ellipsoid, oracle_frustum, oracle_plane, oracle_rectangle, oracle_sphere,
    oracle_torus, oracle_triangle,
};
use glam::{DVec3, Vec3};
use pinhole::shapes::{
    Ellipsoid, Frustum, FrustumShape, Listed, PlacedDisk, PlacedFrustum, PlacedMesh, PlacedPlane, PlacedRectangle,
    PlacedSphere, PlacedTorus, Slabs, TriangleRow,
};
use std::f64::consts::TAU;

/// A shape whose intersections are known exactly.
pub trait Oracle: Listed {
    /// Whether a ray that leaves it on the outside never hits it again.
    const IS_CONVEX: bool = true;
    /// Whether a ray that leaves it on either side never hits it again.
    const IS_PLANAR: bool = false;
    /// How far t may be off where a ray comes from anywhere, relative to itself, in u.
    const FROM_ANYWHERE: f64 = 2.0;
    /// Whether it is asked to tell a ray that touches it exactly from one that misses it.
    const TELLS_TOUCHING: bool = true;

    /// The smallest t > 0 at which a ray intersects it, if any, rounded to f64 once.
    fn exact_t(&self, ray: AimedRay) -> Option<f64>;

    /// 1 for a point outside it or on the side of its normal, −1 for one on the other side, 0 for one on its surface,
    /// exactly.
    fn exact_side(&self, point: DVec3) -> i32;

    /// The textbooks' methods for t.
    fn naive_hits() -> Vec<NaiveHit<Self>> {
        Vec::new()
    }

    /// The textbooks' method for the normal, where the exact one is known.
    fn naive_normal() -> Option<NaiveNormal<Self>> {
        None
    }

    /// The angles between two normals and the exact one on the ray's side, in u; nothing where that is unknown or the ray
    /// hits nothing.
    fn normal_angles(&self, _ray: AimedRay, _normals: [Vec3; 2]) -> Option<[f64; 2]> {
        None
    }

    /// Whether a ray first hits it on the side that its origin lies on; not so where it has open ends.
    fn parts_space(&self) -> bool {
        true
    }

    /// A random point inside it or close to its middle, to which rays are aimed; none for one that is infinite.
    fn aim(&self, draws: &mut Draws) -> Option<DVec3> {
        self.bounding_sphere().map(|(centre, radius)| centre + draws.unit_vector() * (0.3 * radius))
    }
}

impl Oracle for PlacedSphere {
    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        let &Self { centre, radius } = self;
        oracle_sphere::sphere_t(origin, direction, oracle_sphere::Sphere { centre, radius })
    }

    fn exact_side(&self, point: DVec3) -> i32 {
        let &Self { centre, radius } = self;
        oracle_sphere::side_of_sphere(point, oracle_sphere::Sphere { centre, radius }) as i32
    }

    fn naive_hits() -> Vec<NaiveHit<Self>> {
        naive_hits::of_spheres()
    }
}

impl Oracle for Ellipsoid {
    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        oracle_ellipsoid::ellipsoid_t(origin, direction, self)
    }

    fn exact_side(&self, point: DVec3) -> i32 {
        oracle_ellipsoid::side_of_ellipsoid(point, self)
    }

    fn naive_hits() -> Vec<NaiveHit<Self>> {
        naive_hits::of_ellipsoids()
    }

    fn naive_normal() -> Option<NaiveNormal<Self>> {
        Some(naive_hits::ELLIPSOID_NORMAL)
    }

    fn normal_angles(&self, ray: AimedRay, normals: [Vec3; 2]) -> Option<[f64; 2]> {
        let AimedRay { origin, direction } = ray;
        let side = f64::from(self.exact_side(origin.as_dvec3()));
        let enclosed = oracle_ellipsoid::enclosed_outward(origin, direction, self);
        let exact = || Some(oracle_ellipsoid::outward(origin, direction, self)?.times(&Dyadic::of(side)));
        angles(normals, enclosed.map(|outward| outward.times(&Enclosure::of(side))), exact)
    }
}

impl Oracle for PlacedPlane {
    const IS_PLANAR: bool = true;
    /// From elsewhere than the eye, t is a difference of two numbers of any size, and as good as they allow.
    const FROM_ANYWHERE: f64 = f64::INFINITY;

    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        let &Self { normal, offset } = self;
        oracle_plane::plane_t(origin, direction, oracle_plane::Plane { normal, offset })
    }

    fn exact_side(&self, point: DVec3) -> i32 {
        let &Self { normal, offset } = self;
        oracle_plane::side_of_plane(point, oracle_plane::Plane { normal, offset }) as i32
    }

    fn naive_hits() -> Vec<NaiveHit<Self>> {
        naive_hits::of_planes()
    }
}

impl Oracle for PlacedDisk {
    const IS_PLANAR: bool = true;

    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        oracle_disk::disk_t(origin, direction, &self.planar)
    }

    fn exact_side(&self, point: DVec3) -> i32 {
        oracle_disk::side_of_planar(point, &self.planar) as i32
    }

    fn naive_hits() -> Vec<NaiveHit<Self>> {
        naive_hits::of_disks()
    }
}

impl Oracle for PlacedRectangle {
    const IS_PLANAR: bool = true;

    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        oracle_rectangle::rectangle_t(origin, direction, &self.planar)
    }

    fn exact_side(&self, point: DVec3) -> i32 {
        oracle_disk::side_of_planar(point, &self.planar) as i32
    }

    fn naive_hits() -> Vec<NaiveHit<Self>> {
        naive_hits::of_rectangles()
    }
}

impl Oracle for Slabs {
    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        oracle_cuboid::cuboid_t(origin, direction, self).map(|(t, _)| t)
    }

    fn exact_side(&self, point: DVec3) -> i32 {
        oracle_cuboid::side_of_cuboid(point, self)
    }

    fn naive_hits() -> Vec<NaiveHit<Self>> {
        naive_hits::of_cuboids()
    }

    fn naive_normal() -> Option<NaiveNormal<Self>> {
        Some(naive_hits::CUBOID_NORMAL)
    }

    fn normal_angles(&self, ray: AimedRay, normals: [Vec3; 2]) -> Option<[f64; 2]> {
        let (_, axis) = oracle_cuboid::cuboid_t(ray.origin, ray.direction, self)?;
        let outward = self.normal[axis];
        let faces = if outward.dot(ray.direction.as_dvec3()) > 0.0 { -outward } else { outward };
        angles(normals, None, || Some(ExactVector::of(faces)))
    }
}

impl Oracle for TriangleRow {
    const IS_PLANAR: bool = true;

    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        oracle_triangle::triangle_t(origin, direction, self.corners)
    }

    fn exact_side(&self, point: DVec3) -> i32 {
        oracle_triangle::side_of_triangle(point, self.corners) as i32
    }

    fn naive_hits() -> Vec<NaiveHit<Self>> {
        naive_hits::of_triangles()
    }

    fn naive_normal() -> Option<NaiveNormal<Self>> {
        Some(naive_hits::TRIANGLE_NORMAL)
    }

    fn normal_angles(&self, ray: AimedRay, normals: [Vec3; 2]) -> Option<[f64; 2]> {
        oracle_triangle::triangle_t(ray.origin, ray.direction, self.corners)?;
        let exact = oracle_triangle::exact_normal(self.corners) * f64::from(self.exact_side(ray.origin.as_dvec3()));
        angles(normals, None, || Some(ExactVector::of(exact / exact.abs().max_element())))
    }
}

impl<C: FrustumShape> Oracle for PlacedFrustum<C>
where
    Self: Listed,
{
    const TELLS_TOUCHING: bool = false;

    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        oracle_frustum::frustum_t(origin, direction, &self.frustum)
    }

    fn exact_side(&self, point: DVec3) -> i32 {
        oracle_frustum::side_of_frustum(point, &self.frustum)
    }

    fn parts_space(&self) -> bool {
        self.frustum.capped
    }

    fn aim(&self, draws: &mut Draws) -> Option<DVec3> {
        Some(within_frustum(&self.frustum, draws))
    }
}

impl Oracle for PlacedTorus {
    const IS_CONVEX: bool = false;
    const TELLS_TOUCHING: bool = false;

    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        oracle_torus::torus_t(origin, direction, self)
    }

    fn exact_side(&self, point: DVec3) -> i32 {
        oracle_torus::side_of_torus(point, self)
    }

    fn aim(&self, draws: &mut Draws) -> Option<DVec3> {
        let [(cos, sin), (out, up)] = [(); 2].map(|()| {
            let angle = draws.between(0.0, TAU);
            (libm::cos(angle), libm::sin(angle))
        });
        let tube = self.minor * draws.unit().sqrt();
        let across = self.major + tube * out;
        Some(self.space.centre + self.space.world_from_unit * DVec3::new(across * cos, tube * up, across * sin))
    }
}

/// A convex mesh: the examples of the component are.
impl Oracle for PlacedMesh {
    /// The ray is rounded once more in the mesh's own space, and a ray that grazes a triangle's plane magnifies that without
    /// a bound: of 20,000 such rays one is off by 400 u.
    const FROM_ANYWHERE: f64 = f64::INFINITY;

    fn exact_t(&self, AimedRay { origin, direction }: AimedRay) -> Option<f64> {
        let t = self.placed_triangles().filter_map(|at| oracle_triangle::triangle_t(origin, direction, at));
        t.reduce(f64::min)
    }

    fn exact_side(&self, point: DVec3) -> i32 {
        let sides = self.placed_triangles().map(|corners| oracle_triangle::side_of_triangle(point, corners) as i32);
        // A mirroring placement turns every triangle round.
        let turned = self.world_from_object.determinant() < 0.0;
        sides.map(|side| if turned { -side } else { side }).max().unwrap_or(0)
    }
}

/// A random point within the side of a cylinder or a cone and between its ends.
fn within_frustum(frustum: &Frustum, draws: &mut Draws) -> DVec3 {
    let (angle, height) = (draws.between(0.0, TAU), draws.between(-1.0, 1.0));
    let radius = (frustum.profile[0] + frustum.profile[1] * height) * draws.unit().sqrt();
    let at = DVec3::new(radius * libm::cos(angle), height, radius * libm::sin(angle));
    frustum.space.centre + frustum.space.world_from_unit * at
}
