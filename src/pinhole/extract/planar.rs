use super::check::{finite_point, positive_length};
use super::pose::normal_world_from_object;
use super::{Pose, eye, pose};
use crate::plan::Census;
use crate::scene::SceneError;
use bevy_ecs::prelude::*;
use glam::DVec3;

/// A plane with two coordinates, x and z, that are 0 at its centre: the common part of disks and rectangles.
///
/// A point p of the plane has the coordinates `along[0]` · (p − centre) and `along[1]` · (p − centre).
/// They are 1 or −1 where a rectangle ends, and the sum of their squares is 1 where a disk does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planar {
    /// The point where both coordinates are 0, relative to the eye.
    pub centre: DVec3,
    /// Its normal on the side of the entity's +y, of length 1 to within f32, with components exact in f32, so that the
    /// normals of surface and plane are the same numbers.
    pub normal: DVec3,
    /// The vectors that give the coordinates, per scene unit.
    pub along: [DVec3; 2],
    /// The root of the sum of the squares of `along`: no offset changes a coordinate by more than this times its
    /// length.
    pub norm: f64,
}

impl Planar {
    /// The plane with half edges x and z from its centre; none where these span no area.
    pub fn new(centre: DVec3, normal: DVec3, half_edges: [DVec3; 2]) -> Option<Self> {
        let [x, z] = half_edges;
        // Normalised to size 1 first, so that no square overflows.
        let (longest_x, longest_z) = (x.abs().max_element(), z.abs().max_element());
        let (x, z) = (x / longest_x, z / longest_z);
        let area = x.cross(z);
        let squared = area.length_squared();
        let along = [z.cross(area) / squared / longest_x, area.cross(x) / squared / longest_z];
        let norm = (along[0].length_squared() + along[1].length_squared()).sqrt();
        let normal = unit_in_f32(normal);
        let usable = squared > 0.0 && norm.is_finite() && normal.is_finite();
        usable.then_some(Self { centre, normal, along, norm })
    }

    /// The two offsets in the plane that change one coordinate by 1 and leave the other.
    pub fn half_edges(&self) -> [DVec3; 2] {
        let ([x, z], n) = (self.along, self.normal);
        let (across_x, across_z) = (z.cross(n), n.cross(x));
        [across_x / x.dot(across_x), across_z / z.dot(across_z)]
    }
}

/// The direction of a vector, with components exact in f32; NaN where it has none.
pub fn unit_in_f32(v: DVec3) -> DVec3 {
    (v / v.abs().max_element()).normalize().as_vec3().as_dvec3()
}

/// The plane of an entity with these half edges along its own x and z axes.
pub fn planar(scene: &Census<'_>, who: &str, entity: Entity, half: [f64; 2]) -> Result<Planar, SceneError> {
    let Pose { world_from_entity, entity_from_world } = pose(scene, who, entity)?;
    let centre = finite_point(who, "position", world_from_entity.translation - eye(scene)?)?;
    let map = world_from_entity.matrix3;
    let half_edges = [map.x_axis * half[0], map.z_axis * half[1]];
    for half_edge in half_edges {
        positive_length(who, "placed size", half_edge.length())?;
    }
    let normal = normal_world_from_object(entity_from_world, DVec3::Y);
    Planar::new(centre, normal, half_edges).ok_or_else(|| {
        let accepted = "its placement and its parents' must leave it an area that f64 can hold";
        SceneError::new(who, "placement", "one that leaves no area", accepted)
    })
}
