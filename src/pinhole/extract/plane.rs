use super::camera::eye;
use super::check::{finite_point, kind_and_name, triple};
use super::pose::{normal_world_from_object, pose};
use super::shape_kind::numbered;
use crate::plan::{Census, Table};
use crate::scene::{Plane, SceneError};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// Planes in render space, in spawn order: the points x with n·x = k.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlaneTable {
    /// The normal n, of length 1 to within f32, with components exact in f32, so that the normals of surface and plane
    /// are the same numbers.
    pub normal: Vec<DVec3>,
    /// The offset k, in scene units.
    pub offset: Vec<f64>,
    /// The shape's number.
    pub shape: Vec<u32>,
}

impl Table for PlaneTable {
    const NAME: &'static str = "planes";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let eye = eye(scene)?;
        let mut table = Self::default();
        for (shape, entity) in numbered::<Plane>(scene) {
            let Some(plane) = scene.get::<Plane>(entity) else { continue };
            let who = kind_and_name(scene, "plane", entity);
            let pose = pose(scene, &who, entity)?;
            let largest = plane.normal.abs().max_element();
            if !(largest > 0.0 && plane.normal.is_finite()) {
                let accepted = "it must be a finite direction other than 0";
                return Err(SceneError::new(who, "normal", triple(plane.normal), accepted));
            }
            let along = normal_world_from_object(pose.entity_from_world, plane.normal / largest);
            let normal = (along / along.abs().max_element()).normalize().as_vec3().as_dvec3();
            let point = finite_point(&who, "position", pose.world_from_entity.translation - eye)?;
            table.normal.push(normal);
            table.offset.push(normal.dot(point));
            table.shape.push(shape as u32);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.normal.len() * (4 * size_of::<f64>() + size_of::<u32>())
    }
}
