use super::{CuboidTable, DiskTable, RectangleTable, TriangleTable, UvSpaceTable, face_axes, shape_entities};
use crate::plan::{Census, Table};
use crate::scene::{Plane, SceneError, Sphere};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// How u and v change along a shape's surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum UvSlope {
    /// They do not.
    #[default]
    Nowhere,
    /// By the same everywhere: by these a step of the world.
    Planar([DVec3; 2]),
    /// As longitude and latitude do about the origin of the shape's own space.
    Round,
    /// As on the face across one of three axes: by these a step of the world.
    Faces([DVec3; 3]),
}

/// The axis that a vector has most of; y where there is no telling.
#[inline(always)]
pub fn most_of(v: DVec3) -> usize {
    let size = v.abs();
    if size.y >= size.x && size.y >= size.z {
        1
    } else if size.z >= size.x {
        2
    } else {
        0
    }
}

impl UvSlope {
    /// How much u and v change where a hit moves by a step, of the world and in the shape's own space; `own` is the hit
    /// there, `normal` the surface's in the world.
    ///
    /// Not finite where there is no telling, such as at the poles of a sphere.
    #[inline(always)]
    pub fn step(&self, own: DVec3, normal: DVec3, step: DVec3, own_step: DVec3) -> DVec3 {
        match self {
            Self::Nowhere => DVec3::ZERO,
            Self::Planar([u, v]) => DVec3::new(u.dot(step), v.dot(step), 0.0),
            Self::Round => round_step(own, own_step),
            Self::Faces(slopes) => {
                let axis = most_of(DVec3::from(slopes.map(|slope| normal.dot(slope) / slope.length())));
                let [u, v] = face_axes(axis, own[axis] < 0.0);
                let moved = DVec3::from(slopes.map(|slope| 0.5 * slope.dot(step)));
                DVec3::new(u.dot(moved), v.dot(moved), 0.0)
            }
        }
    }
}

/// How much longitude over 2π and the angle from the top over π change along a step from a point.
///
/// The derivatives of the two arc tangents that they are.
#[inline(always)]
fn round_step(own: DVec3, step: DVec3) -> DVec3 {
    let across_squared = own.x * own.x + own.z * own.z;
    let across = across_squared.sqrt();
    let outward = (own.x * step.x + own.z * step.z) / across;
    let longitude = (own.z * step.x - own.x * step.z) / across_squared;
    let from_top = (own.y * outward - across * step.y) / (across_squared + own.y * own.y);
    DVec3::new(longitude / TAU, from_top / PI, 0.0)
}

/// That of a triangle with these two edges from its first corner, by u and v of its corners.
fn planar_slope([one, other]: [DVec3; 2], uvs: [DVec2; 3]) -> UvSlope {
    let across = one.cross(other);
    let area_squared = across.length_squared();
    // Along the one edge the first changes by 1 and the second by 0, along the other the other way round.
    let (first, second) = (other.cross(across) / area_squared, across.cross(one) / area_squared);
    let (along_one, along_other) = (uvs[1] - uvs[0], uvs[2] - uvs[0]);
    UvSlope::Planar([0, 1].map(|part| first * along_one[part] + second * along_other[part]))
}

/// How u and v change along each shape, in the order of the shapes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UvSlopes {
    /// One a shape.
    pub slope: Vec<UvSlope>,
}

impl Table for UvSlopes {
    const NAME: &'static str = "uv slopes";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let shapes = shape_entities(scene);
        let spaces = scene.table::<UvSpaceTable>()?;
        let mut slope = vec![UvSlope::Nowhere; shapes.len()];
        for (shape, entity) in shapes.iter().copied().enumerate() {
            if scene.get::<Plane>(entity).is_some() {
                let matrix = spaces.uv_from_world[shape];
                slope[shape] = UvSlope::Planar([matrix.row(0), matrix.row(1)]);
            } else if scene.get::<Sphere>(entity).is_some() {
                slope[shape] = UvSlope::Round;
            }
        }
        // Their coordinates go from −1 to 1 where u and v go from 0 to 1.
        let (disks, rectangles) = (scene.table::<DiskTable>()?, scene.table::<RectangleTable>()?);
        let planar_shapes =
            disks.planar.iter().zip(&disks.shape).chain(rectangles.planar.iter().zip(&rectangles.shape));
        for (planar, &shape) in planar_shapes {
            slope[shape as usize] = UvSlope::Planar(planar.along.map(|along| 0.5 * along));
        }
        let cuboids = scene.table::<CuboidTable>()?;
        for (slabs, &shape) in cuboids.slabs.iter().zip(&cuboids.shape) {
            slope[shape as usize] = UvSlope::Faces([0, 1, 2].map(|axis| slabs.normal[axis] / slabs.half[axis]));
        }
        let triangles = scene.table::<TriangleTable>()?;
        for (triangle, &shape) in triangles.shape.iter().enumerate() {
            let [a, b, c] = triangles.facet[triangle].corners;
            slope[shape as usize] = planar_slope([b - a, c - a], triangles.uvs[triangle]);
        }
        Ok(Self { slope })
    }

    fn bytes(&self) -> usize {
        self.slope.len() * size_of::<UvSlope>()
    }
}
