use super::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// Rough metal: a surface of tiny mirrors, spread about its normal as GGX has it.
///
/// A larger roughness blurs more; light that would meet a second tiny mirror is lost, unless it is followed.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Metal {
    /// The share of the light that each tiny mirror sends on, the same at all angles, linear Rec. 709, each part from 0
    /// to 1.
    pub colour: Rgb,
    /// GGX's α, from 0 to 1; below 0.001 it is a perfect mirror.
    pub roughness: f64,
    /// Whether light that meets several tiny mirrors comes out too; else rough metal is too dark, at α = 1 by up to 69 %.
    pub multiple_scattering: bool,
}

impl Default for Metal {
    fn default() -> Self {
        Self { colour: Rgb::grey(0.9), roughness: 0.2, multiple_scattering: false }
    }
}
