use super::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A matte surface with a highlight about the direction half way between light and eye (Blinn 1977).
///
/// It sends colour / π + specular · N cosⁿβ of the irradiance towards the eye, with the exponent n, the angle β between
/// the normal and the half-way direction, and N = (n + 2)(n + 4) / (8π(n + 2^(−n/2))), for which a surface that is lit
/// squarely sends on exactly its specular share (Giesen, "Phong Normalization Factor derivation", 2009).
/// In each channel colour and specular come to at most 1 together.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BlinnPhong {
    /// The share of the light that is sent on equally in all directions, linear Rec. 709, each part from 0 to 1.
    pub colour: Rgb,
    /// The largest share that the highlight may send on, linear Rec. 709, each part from 0 to 1.
    pub specular: Rgb,
    /// How narrow the highlight is, from 0 to 1e9; about four times a Phong exponent for the same width.
    pub exponent: f64,
}

impl Default for BlinnPhong {
    fn default() -> Self {
        Self { colour: Rgb::grey(0.4), specular: Rgb::grey(0.2), exponent: 200.0 }
    }
}
