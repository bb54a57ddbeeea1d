use super::check::{kind_and_name, light_colour};
use super::pose::ahead;
use crate::plan::{Table, entities};
use crate::scene::{DirectionalLight, Refusal};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// Directional lights in render space, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DirectionalLightTable {
    /// The way to each light, against its rays: a unit vector.
    pub to_light: Vec<DVec3>,
    /// What a surface that faces it receives, linear Rec. 709.
    pub irradiance: Vec<[f64; 3]>,
    /// Whether things in between keep its light away.
    pub casts_shadows: Vec<bool>,
}

impl Table for DirectionalLightTable {
    const NAME: &'static str = "directional lights";

    fn extract(scene: &World) -> Result<Self, Refusal> {
        let mut table = Self::default();
        for entity in entities::<With<DirectionalLight>>(scene) {
            let light = scene.get::<DirectionalLight>(entity).copied().unwrap_or_default();
            let who = kind_and_name(scene, "directional light", entity);
            table.to_light.push(-ahead(scene, &who, entity)?);
            table.irradiance.push(light_colour(&who, "irradiance", light.irradiance)?.to_array());
            table.casts_shadows.push(light.casts_shadows);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.to_light.len() * (size_of::<DVec3>() + size_of::<[f64; 3]>() + size_of::<bool>())
    }
}
