use super::check::{kind_and_name, positive_length};
use super::planar::{Planar, planar};
use super::shape_kind::numbered;
use super::velocity::moves_while_open;
use crate::plan::{Census, Table};
use crate::scene::{Rectangle, SceneError};
use bevy_ecs::prelude::*;

/// Rectangles in render space, in spawn order, except for those that [move](super::MovingTable): points of a plane
/// whose two coordinates are both from −1 to 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RectangleTable {
    /// The plane with its two coordinates.
    pub planar: Vec<Planar>,
    /// The shape's number.
    pub shape: Vec<u32>,
}

impl Table for RectangleTable {
    const NAME: &'static str = "rectangles";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (mut table, moves) = (Self::default(), moves_while_open(scene));
        for (shape, entity) in numbered::<Rectangle>(scene).into_iter().filter(|&(_, entity)| !moves(entity)) {
            let Some(rectangle) = scene.get::<Rectangle>(entity) else { continue };
            let who = kind_and_name(scene, "rectangle", entity);
            let width = positive_length(&who, "width", rectangle.width)?;
            let depth = positive_length(&who, "depth", rectangle.depth)?;
            table.planar.push(planar(scene, &who, entity, [width / 2.0, depth / 2.0])?);
            table.shape.push(shape as u32);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.planar.len() * (size_of::<Planar>() + size_of::<u32>())
    }
}
