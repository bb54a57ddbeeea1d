use super::{CuboidTable, DiskTable, RectangleTable, UvSpaceTable, shape_entities};
use crate::plan::Table;
use crate::scene::{Plane, Refusal, Sphere};
use bevy_ecs::prelude::*;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// How u and v change along a shape's surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum UvSlope {
    /// They do not, as far as this table knows.
    #[default]
    Unknown,
    /// By the same everywhere: by these a step of the world.
    Flat([DVec3; 2]),
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
            Self::Unknown => DVec3::ZERO,
            Self::Flat([u, v]) => DVec3::new(u.dot(step), v.dot(step), 0.0),
            Self::Round => round_step(own, own_step),
            Self::Faces(slopes) => {
                let facing = slopes.map(|slope| normal.dot(slope) / slope.length());
                let axis = most_of(DVec3::from(facing));
                let along = |axis: usize| 0.5 * slopes[axis].dot(step);
                match axis {
                    0 => DVec3::new(along(2), along(1), 0.0),
                    1 => DVec3::new(along(0), along(2), 0.0),
                    _ => DVec3::new(along(0), along(1), 0.0),
                }
            }
        }
    }
}

// ANCHOR: round_step
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
// ANCHOR_END: round_step

/// How u and v change along each shape, in the order of the shapes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UvSlopes {
    /// One a shape.
    pub slope: Vec<UvSlope>,
}

impl Table for UvSlopes {
    const NAME: &'static str = "uv slopes";

    fn extract(scene: &World) -> Result<Self, Refusal> {
        let shapes = shape_entities(scene);
        let spaces = UvSpaceTable::extract(scene)?;
        let mut slope = vec![UvSlope::Unknown; shapes.len()];
        for (shape, entity) in shapes.into_iter().enumerate() {
            if scene.get::<Plane>(entity).is_some() {
                let matrix = spaces.uv_from_world[shape];
                slope[shape] = UvSlope::Flat([matrix.row(0), matrix.row(1)]);
            } else if scene.get::<Sphere>(entity).is_some() {
                slope[shape] = UvSlope::Round;
            }
        }
        // Their coordinates go from −1 to 1 where u and v go from 0 to 1.
        let (disks, rectangles) = (DiskTable::extract(scene)?, RectangleTable::extract(scene)?);
        let flats = disks.flat.iter().zip(&disks.shape).chain(rectangles.flat.iter().zip(&rectangles.shape));
        for (flat, &shape) in flats {
            slope[shape as usize] = UvSlope::Flat(flat.along.map(|along| 0.5 * along));
        }
        let cuboids = CuboidTable::extract(scene)?;
        for (slabs, &shape) in cuboids.slabs.iter().zip(&cuboids.shape) {
            slope[shape as usize] = UvSlope::Faces([0, 1, 2].map(|axis| slabs.normal[axis] / slabs.half[axis]));
        }
        Ok(Self { slope })
    }

    fn bytes(&self) -> usize {
        self.slope.len() * size_of::<UvSlope>()
    }
}
