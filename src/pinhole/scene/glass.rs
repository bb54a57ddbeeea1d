use super::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// Clear matter with a smooth surface: it reflects a part of the light and refracts the rest.
///
/// The shape must be closed, or a surface that divides all of space; what lies on the inner side of its normal is glass.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Glass {
    /// The index of refraction against the vacuum, above 0; a higher one bends light more.
    pub ior: f64,
    /// How much light is absorbed along a way inside: e^(−absorption · length) is left, each part at least 0.
    pub absorption: Rgb,
    /// Where two shapes of glass overlap, the higher priority says which of them is there.
    pub priority: u32,
}

impl Default for Glass {
    fn default() -> Self {
        Self { ior: 1.5, absorption: Rgb::BLACK, priority: 0 }
    }
}
