use super::check::{finite_point, kind_and_name, light_colour};
use super::{eye, world_from_entity};
use crate::plan::{Census, Table};
use crate::scene::{PointLight, SceneError};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// Point lights in render space, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointLightTable {
    /// The position of each.
    pub position: Vec<DVec3>,
    /// Radiant intensity, linear Rec. 709.
    pub intensity: Vec<[f64; 3]>,
    /// Whether shapes block its light.
    pub casts_shadows: Vec<bool>,
}

impl Table for PointLightTable {
    const NAME: &'static str = "point lights";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let eye = eye(scene)?;
        let mut table = Self::default();
        for &entity in scene.entities::<With<PointLight>>().iter() {
            let light = scene.get::<PointLight>(entity).copied().unwrap_or_default();
            let who = kind_and_name(scene, "point light", entity);
            let pose = world_from_entity(scene, &who, entity)?;
            table.position.push(finite_point(&who, "position", pose.translation - eye)?);
            table.intensity.push(light_colour(&who, "intensity", light.intensity)?.to_array());
            table.casts_shadows.push(light.casts_shadows);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.position.len() * (size_of::<DVec3>() + size_of::<[f64; 3]>() + size_of::<bool>())
    }
}
