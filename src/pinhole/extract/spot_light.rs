use super::check::{finite_point, kind_and_name, light_colour, number};
use super::pose::ahead;
use super::{eye, world_from_entity};
use crate::plan::{Census, Table};
use crate::scene::{Degrees, SceneError, SpotLight};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// Spot lights in render space, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpotLightTable {
    /// The position of each.
    pub position: Vec<DVec3>,
    /// The direction of its axis: a unit vector.
    pub axis: Vec<DVec3>,
    /// Radiant intensity along the axis, linear Rec. 709.
    pub intensity: Vec<[f64; 3]>,
    /// 1 − cos of the half angle of the inner cone.
    pub inner: Vec<f64>,
    /// 1 − cos of the half angle of the outer cone.
    pub outer: Vec<f64>,
    /// Whether shapes block its light.
    pub casts_shadows: Vec<bool>,
}

impl Table for SpotLightTable {
    const NAME: &'static str = "spot lights";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let eye = eye(scene)?;
        let mut table = Self::default();
        for &entity in scene.entities::<With<SpotLight>>().iter() {
            let light = scene.get::<SpotLight>(entity).copied().unwrap_or_default();
            let who = kind_and_name(scene, "spot light", entity);
            let pose = world_from_entity(scene, &who, entity)?;
            let [inner, outer] = cone(&who, &light)?;
            table.position.push(finite_point(&who, "position", pose.translation - eye)?);
            table.axis.push(ahead(scene, &who, entity)?);
            table.intensity.push(light_colour(&who, "intensity", light.intensity)?.to_array());
            table.inner.push(inner);
            table.outer.push(outer);
            table.casts_shadows.push(light.casts_shadows);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.position.len() * (2 * size_of::<DVec3>() + size_of::<[f64; 5]>() + size_of::<bool>())
    }
}

/// 1 − cos of the half angles of the inner and the outer cone.
fn cone(who: &str, light: &SpotLight) -> Result<[f64; 2], SceneError> {
    let (Degrees(inner), Degrees(outer)) = (light.inner_angle, light.outer_angle);
    if !(outer > 0.0 && outer <= 180.0) {
        let value = format!("{}°", number(outer));
        return Err(SceneError::new(who, "outer_angle", value, "it must be an angle above 0° and up to 180°"));
    }
    if !(inner >= 0.0 && inner <= outer) {
        let accepted = format!("it must be an angle from 0° to the outer angle, {}°", number(outer));
        return Err(SceneError::new(who, "inner_angle", format!("{}°", number(inner)), accepted));
    }
    Ok([versine_of_half(light.inner_angle), versine_of_half(light.outer_angle)])
}

/// 1 − cos of half an angle, as 2 sin² of its quarter, which keeps the digits of a small angle.
pub fn versine_of_half(angle: Degrees) -> f64 {
    let sine = libm::sin(angle.radians() / 4.0);
    2.0 * sine * sine
}
