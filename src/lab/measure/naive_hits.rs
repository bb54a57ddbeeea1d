//! What the textbooks have for each shape, as a table: each method, and the shape as its numbers hold it.

use super::ray_aim::AimedRay;
use crate::naive::cuboid::{face_by_epsilon, hit_f32 as cuboid_f32, hit_widened_f32};
use crate::naive::ellipsoid::{hit_f32 as ellipsoid_f32, hit_renormalised, normal_as_direction};
use crate::naive::planar::{hit_disk_f32, hit_rectangle_f32};
use crate::naive::plane::hit_f32 as plane_f32;
use crate::naive::sphere::{hit_f32 as sphere_f32, hit_f64_plain, hit_haines_f32};
use crate::naive::triangle::{hit_f32 as triangle_f32, hit_woop_f32};
use glam::{DMat3, DVec3, Vec3};
use pinhole::shapes::{Ellipsoid, PlacedDisk, PlacedPlane, PlacedRectangle, PlacedSphere, Planar, Slabs, TriangleRow};

/// A naive method for the distance t.
pub struct NaiveHit<S> {
    /// What a table calls it.
    pub name: &'static str,
    /// The distance that it finds.
    pub t: fn(&S, AimedRay) -> Option<f64>,
    /// The shape that its numbers can hold, by which it is checked.
    pub seen: fn(&S) -> S,
}

/// A naive method for the normal; on which side of the surface it points does not matter.
pub struct NaiveNormal<S> {
    /// What a table calls it.
    pub name: &'static str,
    /// The normal where a ray hits it at t, not of unit length.
    pub normal: fn(&S, AimedRay, f64) -> Vec3,
}

fn in_f32(vector: DVec3) -> DVec3 {
    vector.as_vec3().as_dvec3()
}

/// Those of spheres.
pub fn of_spheres() -> Vec<NaiveHit<PlacedSphere>> {
    let seen: fn(&PlacedSphere) -> PlacedSphere =
        |sphere| PlacedSphere { centre: in_f32(sphere.centre), radius: f64::from(sphere.radius as f32) };
    vec![
        NaiveHit {
            name: "naive b2 - 4ac, f32",
            t: |sphere, ray| {
                let (centre, radius) = (sphere.centre.as_vec3(), sphere.radius as f32);
                sphere_f32(ray.origin, ray.direction, centre, radius).map(f64::from)
            },
            seen,
        },
        NaiveHit {
            name: "naive perpendicular form, f32",
            t: |sphere, ray| {
                let (centre, radius) = (sphere.centre.as_vec3(), sphere.radius as f32);
                hit_haines_f32(ray.origin, ray.direction, centre, radius).map(f64::from)
            },
            seen,
        },
        NaiveHit {
            name: "naive b2 - ac, f64",
            t: |sphere, ray| hit_f64_plain(ray.origin, ray.direction, sphere.centre, sphere.radius),
            seen: Clone::clone,
        },
    ]
}

/// Those of ellipsoids.
pub fn of_ellipsoids() -> Vec<NaiveHit<Ellipsoid>> {
    vec![
        NaiveHit {
            name: "naive, unit direction in the object",
            t: |shape, ray| {
                let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
                hit_renormalised(origin, direction, shape.centre, shape.unit_from_world)
            },
            seen: Clone::clone,
        },
        NaiveHit {
            name: "naive b2 - 4ac in the object, f32",
            t: |shape, ray| {
                let (centre, map) = (shape.centre.as_vec3(), shape.unit_from_world.as_mat3());
                ellipsoid_f32(ray.origin, ray.direction, centre, map).map(f64::from)
            },
            seen: |shape| Ellipsoid {
                centre: in_f32(shape.centre),
                unit_from_world: shape.unit_from_world.as_mat3().as_dmat3(),
                ..*shape
            },
        },
    ]
}

/// That of the normals of ellipsoids.
pub const ELLIPSOID_NORMAL: NaiveNormal<Ellipsoid> = NaiveNormal {
    name: "naive, normal as a direction",
    normal: |shape, ray, t| {
        let point = ray.origin.as_dvec3() + t * ray.direction.as_dvec3();
        let world_from_unit: DMat3 = shape.unit_from_world.inverse();
        normal_as_direction(world_from_unit, shape.unit_from_world * (point - shape.centre)).as_vec3()
    },
};

/// Those of planes.
pub fn of_planes() -> Vec<NaiveHit<PlacedPlane>> {
    vec![NaiveHit {
        name: "naive, |n.d| > 1e-6, t > 1e-3, f32",
        t: |plane, ray| {
            plane_f32(ray.origin, ray.direction, plane.normal.as_vec3(), plane.offset as f32).map(f64::from)
        },
        seen: |plane| PlacedPlane { normal: in_f32(plane.normal), offset: f64::from(plane.offset as f32) },
    }]
}

fn planar_in_f32(planar: &Planar) -> Planar {
    Planar { centre: in_f32(planar.centre), along: planar.along.map(in_f32), ..*planar }
}

/// What a method in f32 for a planar shape reads: its centre, its normal, and its coordinates' directions.
fn planar_parts(planar: &Planar) -> (Vec3, Vec3, [Vec3; 2]) {
    (planar.centre.as_vec3(), planar.normal.as_vec3(), planar.along.map(|along| along.as_vec3()))
}

/// Those of disks.
pub fn of_disks() -> Vec<NaiveHit<PlacedDisk>> {
    vec![NaiveHit {
        name: "naive, f32 hit point, then inside",
        t: |disk, ray| {
            let (centre, normal, along) = planar_parts(&disk.planar);
            hit_disk_f32(ray.origin, ray.direction, centre, normal, along).map(f64::from)
        },
        seen: |disk| PlacedDisk { planar: planar_in_f32(&disk.planar) },
    }]
}

/// Those of rectangles.
pub fn of_rectangles() -> Vec<NaiveHit<PlacedRectangle>> {
    vec![NaiveHit {
        name: "naive, f32 hit point, then inside",
        t: |rectangle, ray| {
            let (centre, normal, along) = planar_parts(&rectangle.planar);
            hit_rectangle_f32(ray.origin, ray.direction, centre, normal, along).map(f64::from)
        },
        seen: |rectangle| PlacedRectangle { planar: planar_in_f32(&rectangle.planar) },
    }]
}

/// A ray in the space in which the cuboid is the cube from −1 to 1.
fn ray_in_cube(slabs: &Slabs, ray: AimedRay) -> [Vec3; 2] {
    let (centre, half) = (slabs.centre.as_vec3(), slabs.half.map(|half| half as f32));
    let in_cube = |v: Vec3| Vec3::from([0, 1, 2].map(|axis| slabs.normal[axis].as_vec3().dot(v) / half[axis]));
    [in_cube(ray.origin - centre), in_cube(ray.direction)]
}

/// Those of cuboids.
pub fn of_cuboids() -> Vec<NaiveHit<Slabs>> {
    let seen: fn(&Slabs) -> Slabs =
        |slabs| Slabs { centre: in_f32(slabs.centre), half: slabs.half.map(|half| f64::from(half as f32)), ..*slabs };
    vec![
        NaiveHit {
            name: "naive, slabs by min and max, f32",
            t: |slabs, ray| {
                let [origin, direction] = ray_in_cube(slabs, ray);
                cuboid_f32(origin, direction).map(f64::from)
            },
            seen,
        },
        NaiveHit {
            name: "naive, far side widened, f32",
            t: |slabs, ray| {
                let [origin, direction] = ray_in_cube(slabs, ray);
                hit_widened_f32(origin, direction).map(f64::from)
            },
            seen,
        },
    ]
}

/// That of the normals of cuboids.
pub const CUBOID_NORMAL: NaiveNormal<Slabs> = NaiveNormal {
    name: "naive, the face within 1e-4",
    normal: |slabs, ray, t| {
        let [origin, direction] = ray_in_cube(slabs, ray);
        let axis = face_by_epsilon(origin + t as f32 * direction);
        axis.map_or(Vec3::ZERO, |axis| slabs.normal[axis].as_vec3())
    },
};

/// Those of triangles.
pub fn of_triangles() -> Vec<NaiveHit<TriangleRow>> {
    let seen: fn(&TriangleRow) -> TriangleRow = |triangle| TriangleRow::new(triangle.corners.map(in_f32));
    vec![
        NaiveHit {
            name: "naive Moller-Trumbore, 1e-6, f32",
            t: |triangle, ray| {
                let corners = triangle.corners.map(|corner| corner.as_vec3());
                triangle_f32(ray.origin, ray.direction, corners).map(f64::from)
            },
            seen,
        },
        NaiveHit {
            name: "Woop as published, f32, f64 at 0",
            t: |triangle, ray| {
                let corners = triangle.corners.map(|corner| corner.as_vec3());
                hit_woop_f32(ray.origin, ray.direction, corners).map(f64::from)
            },
            seen,
        },
    ]
}

/// That of the normals of triangles.
pub const TRIANGLE_NORMAL: NaiveNormal<TriangleRow> = NaiveNormal {
    name: "naive, (b-a) x (c-a), f32",
    normal: |triangle, _, _| {
        let [a, b, c] = triangle.corners.map(|corner| corner.as_vec3());
        (b - a).cross(c - a).normalize_or_zero()
    },
};
