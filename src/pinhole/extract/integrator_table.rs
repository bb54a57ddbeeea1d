use super::camera_entity::camera_of;
use super::check::{at_most_one, kind_and_name, positive_length};
use super::integrator::integrator_of;
use super::{GlassTable, glass_evidence};
use crate::plan::{Census, Table};
use crate::scene::{Integrator, SceneError};
use bevy_ecs::prelude::*;

/// The integrator's parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct IntegratorTable {
    /// The greatest number of path segments, camera ray included: 1 for emitted light only, 2 for direct light.
    pub max_depth: u32,
    /// The depth from which Russian roulette terminates paths.
    pub roulette: u32,
    /// Whether area lights are sampled (next-event estimation).
    pub samples_lights: bool,
    /// The factor by which radiance is scaled in the densest glass: its index of refraction squared, at least 1.
    pub eta_scale: f64,
    /// Whether light sampling and BSDF sampling are combined by multiple importance sampling.
    pub mis: bool,
    /// The distance within which a shape occludes the sky, in scene units.
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
        let does = integrator_of(scene).integrator.transport();
        let distance = match does.occlusion {
            Some(distance) if distance != f64::INFINITY => positive_length(&who(), "integrator distance", distance)?,
            Some(distance) => distance,
            None => 0.0,
        };
        let table = Self {
            max_depth: does.max_depth,
            roulette: does.roulette,
            samples_lights: does.samples_lights(),
            eta_scale: eta_scale_in_glass(scene)?,
            mis: does.is_mis(),
            distance: distance as f32,
        };
        if table.max_depth == 0 {
            let accepted = "it must be at least 1, for emitted light, or 2, for direct light";
            return Err(SceneError::new(who(), "integrator max_depth", "0", accepted));
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// The largest squared index of refraction among the kinds of glass in use; 1 without any.
fn eta_scale_in_glass(scene: &Census<'_>) -> Result<f64, SceneError> {
    if !glass_evidence(scene).needed {
        return Ok(1.0);
    }
    let densest = scene.table::<GlassTable>()?.ior.iter().copied().fold(1.0, f64::max);
    Ok(densest * densest)
}
