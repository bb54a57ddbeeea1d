use super::check::{finite_point, kind_and_name, number, positive_length};
use super::ellipsoid::even_scale;
use super::{eye, shape_entities, world_from_entity};
use crate::plan::Table;
use crate::scene::{Refusal, Sphere};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// Spheres in render space, in spawn order; those that their placement scales unevenly are
/// [ellipsoids](super::EllipsoidTable).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SphereTable {
    /// Centre, x.
    pub x: Vec<f64>,
    /// Centre, y.
    pub y: Vec<f64>,
    /// Centre, z.
    pub z: Vec<f64>,
    /// Radius, scene units.
    pub radius: Vec<f64>,
    /// The shape's number.
    pub shape: Vec<u32>,
}

impl SphereTable {
    /// The centre of a row.
    pub fn centre(&self, row: usize) -> DVec3 {
        DVec3::new(self.x[row], self.y[row], self.z[row])
    }
}

impl Table for SphereTable {
    const NAME: &'static str = "spheres";

    fn extract(scene: &World) -> Result<Self, Refusal> {
        let eye = eye(scene)?;
        let mut table = Self::default();
        for (shape, entity) in shape_entities(scene).into_iter().enumerate() {
            let Some(sphere) = scene.get::<Sphere>(entity) else { continue };
            let who = kind_and_name(scene, "sphere", entity);
            let pose = world_from_entity(scene, &who, entity)?;
            positive_length(&who, "radius", sphere.radius)?;
            let Some(scale) = even_scale(pose.matrix3) else { continue };
            let centre = finite_point(&who, "position", pose.translation - eye)?;
            table.x.push(centre.x);
            table.y.push(centre.y);
            table.z.push(centre.z);
            let scaled = |refusal: Refusal| {
                let value = format!("{} scaled by {}", number(sphere.radius), number(scale));
                Refusal { value, ..refusal }
            };
            table.radius.push(positive_length(&who, "radius", sphere.radius * scale).map_err(scaled)?);
            table.shape.push(shape as u32);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.x.len() * (4 * size_of::<f64>() + size_of::<u32>())
    }
}
