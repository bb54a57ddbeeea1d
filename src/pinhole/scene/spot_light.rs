use super::{Degrees, Placement, Rgb};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A spotlight: a point light at the entity's position that emits into a cone about the entity's own −z.
///
/// Within the inner cone its intensity is full; from there to the outer cone it falls off smoothly in the cosine (the
/// smoothstep of *Physically Based Rendering*, 4th edition, section 12.2); outside it is zero.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct SpotLight {
    /// Radiant intensity along the axis, linear Rec. 709, each component finite and at least 0.
    pub intensity: Rgb,
    /// The full angle across the inner cone, from 0 to the outer angle.
    pub inner_angle: Degrees,
    /// The full angle across the outer cone, above 0° and up to 180°, which is a half-space.
    pub outer_angle: Degrees,
    /// Whether objects cast shadows in its light; if not, no shadow rays are traced for it.
    pub casts_shadows: bool,
}

impl Default for SpotLight {
    fn default() -> Self {
        let (inner_angle, outer_angle) = (Degrees(40.0), Degrees(60.0));
        Self { intensity: Rgb::grey(1.0), inner_angle, outer_angle, casts_shadows: true }
    }
}
