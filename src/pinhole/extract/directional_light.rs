use super::check::{kind_and_name, light_colour};
use super::pose::ahead;
use crate::plan::{Census, Table};
use crate::scene::{DirectionalLight, SceneError};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// Directional lights in render space, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DirectionalLightTable {
    /// The direction to each light, opposite to its rays: a unit vector.
    pub to_light: Vec<DVec3>,
    /// The irradiance of a surface that faces the light, linear Rec. 709.
    pub irradiance: Vec<[f64; 3]>,
    /// Whether shapes block its light.
    pub casts_shadows: Vec<bool>,
}

impl Table for DirectionalLightTable {
    const NAME: &'static str = "directional lights";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for &entity in scene.entities::<With<DirectionalLight>>().iter() {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{ChildOf, LookAt, Placement};
    use glam::DQuat;

    fn to_light(spawn: impl FnOnce(&mut World)) -> DVec3 {
        let mut world = World::new();
        spawn(&mut world);
        DirectionalLightTable::extract(&Census::of(&world)).expect("extracts").to_light[0]
    }

    /// Rays travel along −z, so the light is towards +z; rotated, looked at, scaled, mirrored, under a parent, moved.
    #[test]
    fn the_light_is_against_the_entity_s_own_minus_z() {
        let light = DirectionalLight::default();
        let half = std::f64::consts::FRAC_1_SQRT_2;
        assert_eq!(to_light(|w| _ = w.spawn(light)), DVec3::Z);
        assert_eq!(to_light(|w| _ = w.spawn((light, Placement::at(5.0, -7.0, 1e9)))), DVec3::Z);
        let turned = Placement { orientation: DQuat::from_xyzw(0.0, half, 0.0, half), ..Placement::default() };
        assert!((to_light(|w| _ = w.spawn((light, turned))) - DVec3::X).length() < 1e-15);
        let look = LookAt { eye: DVec3::new(0.0, 3.0, 4.0), target: DVec3::ZERO, up: DVec3::Y };
        assert!((to_light(|w| _ = w.spawn((light, look))) - DVec3::new(0.0, 0.6, 0.8)).length() < 1e-15);
        let scaled = Placement { scale: DVec3::new(2.0, 3.0, 1e-12), ..Placement::default() };
        assert_eq!(to_light(|w| _ = w.spawn((light, scaled))), DVec3::Z);
        let mirrored = Placement { scale: DVec3::new(1.0, 1.0, -1.0), ..Placement::default() };
        assert_eq!(to_light(|w| _ = w.spawn((light, mirrored))), DVec3::NEG_Z, "its own −z is mirrored with it");
        let under = to_light(|world| {
            let parent = world.spawn(turned).id();
            world.spawn((light, ChildOf(parent)));
        });
        assert!((under - DVec3::X).length() < 1e-15);
    }
}
