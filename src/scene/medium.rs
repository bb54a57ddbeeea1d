//! What fills space and scatters light there, such as fog.

use crate::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A participating medium, such as fog, smoke or milk: it absorbs and scatters the light that passes through it, alike at
/// every place or, with a [`DensityGrid`](super::DensityGrid) beside it, as that says.
///
/// Where it stands says what it fills.
/// On an entity with a closed shape and no material it fills that shape, which then has no surface: rays and light pass
/// its boundary and are attenuated inside.
/// Beside a [`Glass`](super::Glass) or [`RoughGlass`](super::RoughGlass) it fills the glass, whose own absorption adds.
/// On an entity with neither, such as the camera, it fills all of space but glass; one entity of a scene may have that.
/// Where media overlap, their coefficients add.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Medium {
    /// The absorption coefficient per scene unit, linear Rec. 709, each component finite and at least 0.
    pub absorption: Rgb,
    /// The scattering coefficient per scene unit: 1 / scattering is the mean distance between two scattering events; each
    /// component finite and at least 0.
    pub scattering: Rgb,
    /// The mean cosine g of the angle by which light is scattered (Henyey and Greenstein 1941), above −1 and below 1:
    /// towards 1 light goes on forward, 0 is isotropic, below 0 it turns back.
    pub anisotropy: f64,
    /// The radiance emitted per scene unit in every direction, linear Rec. 709, each component finite and at least 0.
    #[serde(skip_serializing_if = "is_black")]
    pub emission: Rgb,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_black(emission: &Rgb) -> bool {
    *emission == Rgb::BLACK
}

impl Default for Medium {
    fn default() -> Self {
        Self { absorption: Rgb::BLACK, scattering: Rgb::grey(0.1), anisotropy: 0.0, emission: Rgb::BLACK }
    }
}
