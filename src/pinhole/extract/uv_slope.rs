use super::{CuboidTable, DiskTable, RectangleTable, TriangleTable, UvSpaceTable, face_axes, shape_entities};
use crate::plan::{Census, Table};
use crate::scene::{Plane, SceneError, Sphere};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// The gradients of u and v along a shape's surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum UvSlope {
    /// There are none.
    #[default]
    Nowhere,
    /// Constant gradients, per scene unit in world space.
    Planar([DVec3; 2]),
    /// Those of longitude and latitude about the origin of the shape's object space.
    Round,
    /// Those of cuboid faces, by axis, per scene unit in world space.
    Faces([DVec3; 3]),
}

/// The axis of a vector's largest component; y where none is.
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
    /// The change of u and v where a hit moves by an offset, given in world and object space; `own` is the hit in
    /// object space, `normal` the surface normal in world space.
    ///
    /// Not finite where it is undefined, such as at the poles of a sphere.
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

/// The change of longitude over 2π and of the polar angle over π along an offset from a point.
///
/// These are the derivatives of the two arc tangents.
#[inline(always)]
fn round_step(own: DVec3, step: DVec3) -> DVec3 {
    let across_squared = own.x * own.x + own.z * own.z;
    let across = across_squared.sqrt();
    let outward = (own.x * step.x + own.z * step.z) / across;
    let longitude = (own.z * step.x - own.x * step.z) / across_squared;
    let from_top = (own.y * outward - across * step.y) / (across_squared + own.y * own.y);
    DVec3::new(longitude / TAU, from_top / PI, 0.0)
}

/// The gradients of a triangle with these two edges from its first corner, from u and v of its corners.
fn planar_slope([one, other]: [DVec3; 2], uvs: [DVec2; 3]) -> UvSlope {
    let across = one.cross(other);
    let area_squared = across.length_squared();
    // Along the first edge, the first coordinate changes by 1 and the second by 0; along the second edge, vice versa.
    let (first, second) = (other.cross(across) / area_squared, across.cross(one) / area_squared);
    let (along_one, along_other) = (uvs[1] - uvs[0], uvs[2] - uvs[0]);
    UvSlope::Planar([0, 1].map(|part| first * along_one[part] + second * along_other[part]))
}

/// The gradients of u and v along each shape, in the order of the shapes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UvSlopes {
    /// One for each shape.
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
        // Their plane coordinates run from −1 to 1 where u and v run from 0 to 1.
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
            let [a, b, c] = triangles.triangle[triangle].corners;
            slope[shape as usize] = planar_slope([b - a, c - a], triangles.uvs[triangle]);
        }
        Ok(Self { slope })
    }

    fn bytes(&self) -> usize {
        self.slope.len() * size_of::<UvSlope>()
    }
}
