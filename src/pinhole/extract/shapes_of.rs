use super::camera::eye;
use super::check::{finite_point, kind_and_name};
use super::pose::pose;
use super::shape_kind::{numbered, shape_entities};
use super::velocity::moves_while_open;
use crate::plan::{Census, Table};
use crate::scene::{ChildOf, Placement, SceneError, Triangle};
use crate::shapes::{
    Ellipsoid, Listed, Placed, PlacedDisk, PlacedPlane, PlacedRectangle, PlacedSphere, SceneShape, Slabs, TriangleRow,
    placed_normals,
};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// Shapes of one kind in render space, in spawn order, except for those that [move](super::MovingTable).
#[derive(Clone, Debug, PartialEq)]
pub struct ShapesOf<S: Listed> {
    /// The shapes, as the intersection kernels read them.
    pub row: Vec<S>,
    /// What the surface of each needs besides.
    pub beside: Vec<S::Beside>,
    /// The shape's number.
    pub shape: Vec<u32>,
}

/// The table of spheres.
pub type SphereTable = ShapesOf<PlacedSphere>;
/// The table of spheres with a non-uniform scale.
pub type EllipsoidTable = ShapesOf<Ellipsoid>;
/// The table of planes.
pub type PlaneTable = ShapesOf<PlacedPlane>;
/// The table of disks.
pub type DiskTable = ShapesOf<PlacedDisk>;
/// The table of rectangles.
pub type RectangleTable = ShapesOf<PlacedRectangle>;
/// The table of cuboids.
pub type CuboidTable = ShapesOf<Slabs>;
/// The table of triangles.
pub type TriangleTable = ShapesOf<TriangleRow>;

impl<S: Listed> Default for ShapesOf<S> {
    fn default() -> Self {
        Self { row: Vec::new(), beside: Vec::new(), shape: Vec::new() }
    }
}

impl<S: Listed> ShapesOf<S> {
    /// Appends a shape, with what its surface needs and its number.
    pub fn push(&mut self, (row, beside): (S, S::Beside), shape: u32) {
        self.row.push(row);
        self.beside.push(beside);
        self.shape.push(shape);
    }
}

/// The shapes, numbered from 0.
impl<S: Listed> FromIterator<S> for ShapesOf<S> {
    fn from_iter<I: IntoIterator<Item = S>>(shapes: I) -> Self {
        let mut table = Self::default();
        shapes.into_iter().zip(0..).for_each(|(row, shape)| table.push((row, S::Beside::default()), shape));
        table
    }
}

impl<S: Listed> Table for ShapesOf<S> {
    const NAME: &'static str = S::NAMES.table;

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (eye, moves) = (eye(scene)?, moves_while_open(scene));
        let mut table = Self::default();
        for (shape, entity) in numbered::<S>(scene).into_iter().filter(|&(_, entity)| !moves(entity)) {
            table.push(placed_shape::<S>(scene, entity, eye)?, shape as u32);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.row.len() * (size_of::<S>() + size_of::<S::Beside>() + size_of::<u32>())
    }
}

/// The shape of an entity, at the moment when the shutter opens.
pub(super) fn placed_shape<S: Listed>(
    scene: &Census<'_>,
    entity: Entity,
    eye: DVec3,
) -> Result<(S, S::Beside), SceneError> {
    let component = scene.get::<S::Component>(entity).copied().unwrap_or_default();
    let who = kind_and_name(scene, S::Component::WORD, entity);
    S::place(&component, &placed(scene, &who, entity, eye)?)
}

/// Where a shape's entity is placed.
fn placed<'a>(scene: &Census<'_>, who: &'a str, entity: Entity, eye: DVec3) -> Result<Placed<'a>, SceneError> {
    let pose = pose(scene, who, entity)?;
    let position = finite_point(who, "position", pose.world_from_entity.translation - eye)?;
    let scale = scene.get::<Placement>(entity).copied().unwrap_or_default().scale;
    Ok(Placed { who, pose, position, scale, has_parent: scene.get::<ChildOf>(entity).is_some() })
}

/// Vertex normals in world space, one row per triangle, in the order of [`TriangleTable`] and its sorted corners.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VertexNormalTable {
    /// Unit vectors on the side of the table's normal; all 0 where the author gave none.
    pub normals: Vec<[DVec3; 3]>,
}

impl Table for VertexNormalTable {
    const NAME: &'static str = "vertex normals";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (eye, entities) = (eye(scene)?, shape_entities(scene));
        let mut table = Self::default();
        for &shape in &scene.table::<TriangleTable>()?.shape {
            let entity = entities[shape as usize];
            let triangle = scene.get::<Triangle>(entity).copied().unwrap_or_default();
            let who = kind_and_name(scene, Triangle::WORD, entity);
            let normals = placed_normals(&triangle, &placed(scene, &who, entity, eye)?)?;
            table.normals.push(normals.unwrap_or_default());
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.normals.len() * size_of::<[DVec3; 3]>()
    }
}
