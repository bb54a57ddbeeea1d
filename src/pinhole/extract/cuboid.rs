use super::camera::eye;
use super::check::{finite_point, kind_and_name, positive_length, triple};
use super::planar::unit_in_f32;
use super::pose::normal_world_from_object;
use super::pose::{Pose, pose};
use super::shape_kind::numbered;
use crate::plan::{Census, Table};
use crate::scene::{Cuboid, SceneError};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};

/// The greatest ratio of a cuboid's longest to its shortest edge.
///
/// Normals whose components are exact in f32 rotate a face by up to 2⁻²⁵, which moves its far end by that fraction of
/// the cuboid's length: with this ratio, by less than a third of the thickness.
const LARGEST_RATIO: f64 = 1e7;
/// The factor by which its bounding sphere is enlarged, so that no rounding leads outside it.
const RADIUS_MARGIN: f64 = 1.0 + 1.0 / 1024.0;

/// The points x of render space with |nᵢ · (x − C)| ≤ hᵢ for three normals: a box, or three slabs at any angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slabs {
    /// C, relative to the eye.
    pub centre: DVec3,
    /// The outward normals n of the faces at the entity's +x, +y and +z, of length 1 to within f32, with components
    /// exact in f32, so that the normals of surfaces and of faces are the same numbers.
    pub normal: [DVec3; 3],
    /// h, from the centre to the faces, in units of the length of n.
    pub half: [f64; 3],
    /// The radius of a bounding sphere about the centre.
    pub bounding_radius: f64,
}

impl Slabs {
    /// The slabs whose faces have these normals and are half an edge from the centre.
    pub fn new(centre: DVec3, normals: [DVec3; 3], half_edges: [DVec3; 3]) -> Self {
        let normal = normals.map(unit_in_f32);
        let half = [0, 1, 2].map(|axis| normal[axis].dot(half_edges[axis]));
        let bounding_radius = half_edges.iter().map(|edge| edge.length()).sum::<f64>() * RADIUS_MARGIN;
        Self { centre, normal, half, bounding_radius }
    }

    /// Whether the eye, which is the origin of render space, is inside.
    pub fn contains_the_eye(&self) -> bool {
        (0..3).all(|axis| self.normal[axis].dot(self.centre).abs() < self.half[axis])
    }

    /// The offsets from the centre to the midpoints of the faces at the ends of the three edges.
    pub fn half_edges(&self) -> [DVec3; 3] {
        [0, 1, 2].map(|axis| {
            let along = self.normal[(axis + 1) % 3].cross(self.normal[(axis + 2) % 3]);
            along * (self.half[axis] / self.normal[axis].dot(along))
        })
    }
}

/// Cuboids in render space, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CuboidTable {
    /// Their slabs.
    pub slabs: Vec<Slabs>,
    /// The shape's number.
    pub shape: Vec<u32>,
}

impl Table for CuboidTable {
    const NAME: &'static str = "cuboids";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for (shape, entity) in numbered::<Cuboid>(scene) {
            let Some(cuboid) = scene.get::<Cuboid>(entity) else { continue };
            table.slabs.push(slabs(scene, entity, cuboid.size)?);
            table.shape.push(shape as u32);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.slabs.len() * (size_of::<Slabs>() + size_of::<u32>())
    }
}

fn slabs(scene: &Census<'_>, entity: Entity, size: DVec3) -> Result<Slabs, SceneError> {
    let who = kind_and_name(scene, "cuboid", entity);
    for part in size.to_array() {
        positive_length(&who, "size", part).map_err(|scene_error| SceneError {
            value: triple(size),
            accepted: format!("each part must be{}", scene_error.accepted.trim_start_matches("it must be")),
            ..scene_error
        })?;
    }
    let Pose { world_from_entity, entity_from_world } = pose(scene, &who, entity)?;
    let centre = finite_point(&who, "position", world_from_entity.translation - eye(scene)?)?;
    let half_edges = world_from_entity.matrix3 * DMat3::from_diagonal(size / 2.0);
    let edges = [0, 1, 2].map(|axis| half_edges.col(axis));
    let normals = DVec3::AXES.map(|axis| normal_world_from_object(entity_from_world, axis));
    let slabs = Slabs::new(centre, normals, edges);
    let longest = edges.map(DVec3::length).iter().copied().fold(0.0, f64::max);
    let thinnest = slabs.half.iter().copied().fold(f64::INFINITY, f64::min);
    positive_length(&who, "longest placed edge", longest)?;
    positive_length(&who, "placed thickness", thinnest)?;
    let ratio = longest / thinnest;
    if ratio > LARGEST_RATIO {
        let value = format!("{}, placed {ratio:.1e} times as long as thick", triple(size));
        let accepted = format!("a cuboid may be at most {LARGEST_RATIO:e} times as long as thick");
        return Err(SceneError::new(who, "size", value, accepted));
    }
    Ok(slabs)
}
