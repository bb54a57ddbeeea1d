use super::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A matte surface with a highlight about the mirrored light (Phong 1975, normalised as by Lafortune and Willems 1994).
///
/// It sends colour / π + specular · (n + 2) / 2π · cosⁿα of the irradiance towards the eye, with the exponent n and the
/// angle α between the way to the eye and the mirrored way to the light.
/// In each channel colour and specular come to at most 1 together.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Phong {
    /// The share of the light that is sent on equally in all directions, linear Rec. 709, each part from 0 to 1.
    pub colour: Rgb,
    /// The largest share that the highlight may send on, linear Rec. 709, each part from 0 to 1.
    pub specular: Rgb,
    /// How narrow the highlight is, from 0 to 1e9; the more, the narrower and the brighter.
    pub exponent: f64,
}

impl Default for Phong {
    fn default() -> Self {
        Self { colour: Rgb::grey(0.4), specular: Rgb::grey(0.2), exponent: 50.0 }
    }
}
