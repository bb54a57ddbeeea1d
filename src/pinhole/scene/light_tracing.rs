use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On the camera, beside [`Integrator::Path`](super::Integrator::Path): caustics are traced from the lights (Arvo
/// 1986).
///
/// Paths that leave a light through specular surfaces, and whose last surface before the camera is non-specular, are
/// then found by particles that start on the lights; all others by paths from the camera, as before.
/// Point lights, spotlights and directional lights thus shine through glass too.
/// Light paths start on these, on shapes that emit light and on an [`Environment`](super::Environment), but not on a
/// [`Background`](super::Background) or a [`Gradient`](super::Gradient), whose light the camera's paths find with less
/// variance.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LightTracing {
    /// Light paths per camera path, from 1/1024 to 1024; a fraction of one is often enough.
    pub paths: f64,
}

impl Default for LightTracing {
    fn default() -> Self {
        Self { paths: 1.0 }
    }
}
