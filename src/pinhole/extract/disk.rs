use super::check::{kind_and_name, positive_length};
use super::planar::{Planar, planar};
use super::shape_kind::numbered;
use super::velocity::moves_while_open;
use crate::plan::{Census, Table};
use crate::scene::{Disk, SceneError};
use bevy_ecs::prelude::*;

/// Disks in render space, in spawn order, except for those that [move](super::MovingTable): points of a plane whose two
/// coordinates have squares that add up to at most 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DiskTable {
    /// The plane with its two coordinates.
    pub planar: Vec<Planar>,
    /// The shape's number.
    pub shape: Vec<u32>,
}

impl Table for DiskTable {
    const NAME: &'static str = "disks";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (mut table, moves) = (Self::default(), moves_while_open(scene));
        for (shape, entity) in numbered::<Disk>(scene).into_iter().filter(|&(_, entity)| !moves(entity)) {
            let Some(disk) = scene.get::<Disk>(entity) else { continue };
            let who = kind_and_name(scene, "disk", entity);
            let radius = positive_length(&who, "radius", disk.radius)?;
            table.planar.push(planar(scene, &who, entity, [radius; 2])?);
            table.shape.push(shape as u32);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.planar.len() * (size_of::<Planar>() + size_of::<u32>())
    }
}
