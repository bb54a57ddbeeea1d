use super::{Degrees, Placement, Rgb};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A light without size at the entity's position that shines into a cone about the entity's own −z.
///
/// Within the inner cone its intensity is whole; from there to the outer cone it fades smoothly in the cosine (the
/// smoothstep of *Physically Based Rendering*, 4th edition, section 12.2); beyond there is none.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct SpotLight {
    /// Radiant intensity along the axis, linear Rec. 709, each part finite and at least 0.
    pub intensity: Rgb,
    /// The angle across the whole inner cone, from 0 to the outer angle.
    pub inner_angle: Degrees,
    /// The angle across the whole outer cone, above 0 and up to 180°, which is a half space.
    pub outer_angle: Degrees,
    /// Whether things in between keep its light away; without, no shadow ray is made for this light.
    pub casts_shadows: bool,
}

impl Default for SpotLight {
    fn default() -> Self {
        let (inner_angle, outer_angle) = (Degrees(40.0), Degrees(60.0));
        Self { intensity: Rgb::grey(1.0), inner_angle, outer_angle, casts_shadows: true }
    }
}
