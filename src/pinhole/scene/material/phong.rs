use crate::scene::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A diffuse surface with a highlight about the mirror direction (Phong 1975, normalised by Lafortune and Willems
/// 1994).
///
/// Its BRDF is colour / π + specular · (n + 2) / 2π · cosⁿα, with the exponent n and the angle α between the direction
/// to the eye and the mirrored direction to the light.
/// In each channel colour and specular add up to at most 1.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Phong {
    /// Albedo of the diffuse term, linear Rec. 709, each component from 0 to 1.
    pub colour: Rgb,
    /// Largest albedo of the highlight, linear Rec. 709, each component from 0 to 1.
    pub specular: Rgb,
    /// The exponent, from 0 to 1e9; a larger one makes the highlight smaller and brighter.
    pub exponent: f64,
}

impl Default for Phong {
    fn default() -> Self {
        Self { colour: Rgb::grey(0.4), specular: Rgb::grey(0.2), exponent: 50.0 }
    }
}
