use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On the camera, beside an integrator of paths: caustics are traced from the lights (Arvo 1986).
///
/// Ways of light that leave a light by mirrors or glass, and whose last surface before the camera spreads light, are then
/// found by rays that start on the lights; all others by the camera's rays, as before.
/// So the light of lamps without an area comes through glass too.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LightTracing {
    /// Rays from the lights for every ray of the camera, from 1/1024 to 1024; a part of one will often do.
    pub paths: f64,
}

impl Default for LightTracing {
    fn default() -> Self {
        Self { paths: 1.0 }
    }
}
