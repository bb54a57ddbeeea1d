use super::camera_entity::camera_of;
use super::check::{at_most_one, kind_and_name, positive_length};
use super::glass::{GlassTable, glass_evidence};
use super::integrator::integrator_of;
use crate::plan::{Census, Table};
use crate::scene::{Integrator, LightStrategy, SceneError};
use bevy_ecs::prelude::*;

/// How far light is followed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct IntegratorTable {
    /// The most legs of a way, the one from the camera included.
    pub max_depth: u32,
    /// The leg from which ways end by chance.
    pub roulette: u32,
    /// Whether points on lights are aimed at.
    pub aimed: bool,
    /// How many times as large radiance is in the densest glass as outside: its index of refraction squared, at least 1.
    pub narrowing: f64,
    /// Whether two ways to find a light are weighed against each other.
    pub weighed: bool,
    /// How far something still hides the sky, in scene units.
    pub distance: f32,
}

impl Table for IntegratorTable {
    const NAME: &'static str = "integrator";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let camera = camera_of(scene)?;
        let who = || kind_and_name(scene, "camera", camera);
        if let Some(other) = at_most_one::<Integrator>(scene, "integrator", "Integrator")?
            && other != camera
        {
            let who = kind_and_name(scene, "integrator", other);
            return Err(SceneError::new(who, "integrator", "on no camera", "it must be on the camera"));
        }
        // Without more, light comes from a light by one surface to the camera.
        let mut table = Self { max_depth: 2, narrowing: narrowing_in_glass(scene)?, ..Self::default() };
        match integrator_of(scene).integrator {
            Integrator::RayCasting => {}
            Integrator::AmbientOcclusion { distance } if distance == f64::INFINITY => table.distance = f32::INFINITY,
            Integrator::AmbientOcclusion { distance } => {
                table.distance = positive_length(&who(), "integrator distance", distance)? as f32;
            }
            Integrator::Whitted { max_depth } => table.max_depth = max_depth,
            Integrator::Distribution { max_depth } => (table.max_depth, table.aimed) = (max_depth, true),
            Integrator::Path { max_depth, roulette, lights } => {
                (table.max_depth, table.roulette, table.weighed) = (max_depth, roulette, lights == LightStrategy::Mis);
                table.aimed = lights != LightStrategy::Bsdf;
            }
        }
        if table.max_depth == 0 {
            let accepted = "it must be at least 1, and 2 for light that comes by one surface";
            return Err(SceneError::new(who(), "integrator legs", "0", accepted));
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// The largest index of refraction squared among the kinds of glass that shapes are made of; 1 without any.
fn narrowing_in_glass(scene: &Census<'_>) -> Result<f64, SceneError> {
    if !glass_evidence(scene).needed {
        return Ok(1.0);
    }
    let densest = scene.table::<GlassTable>()?.ior.iter().copied().fold(1.0, f64::max);
    Ok(densest * densest)
}
