use super::eye;
use super::shape_kind::{moving_shapes, one_shape, shape_entities};
use super::velocity::velocity_of;
use crate::plan::{Census, Table};
use crate::scene::SceneError;
use crate::shapes::AnyShape;
use glam::DVec3;

/// Shapes of every kind that move while the shutter is open, in spawn order; the tables of the kinds hold the others.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MovingTable {
    /// The shape at the moment when the shutter opens.
    pub body: Vec<AnyShape>,
    /// Its velocity, in scene units per unit of time.
    pub velocity: Vec<DVec3>,
    /// The shape's number.
    pub shape: Vec<u32>,
}

impl Table for MovingTable {
    const NAME: &'static str = "moving shapes";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let eye = eye(scene)?;
        let mut table = Self::default();
        for &(shape, entity) in moving_shapes(scene).iter() {
            table.body.push((one_shape(scene, entity)?.body)(scene, entity, eye)?);
            table.velocity.push(velocity_of(scene, entity));
            table.shape.push(shape as u32);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.body.len() * (size_of::<AnyShape>() + size_of::<DVec3>() + size_of::<u32>())
    }
}

/// All shapes at the moment when the shutter opens, each of any kind, in spawn order.
///
/// Errors: what is wrong with a shape.
pub fn any_shapes(scene: &Census<'_>) -> Result<Vec<AnyShape>, SceneError> {
    let eye = eye(scene)?;
    shape_entities(scene).iter().map(|&entity| (one_shape(scene, entity)?.body)(scene, entity, eye)).collect()
}
