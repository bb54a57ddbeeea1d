use crate::scene::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A diffuse surface with a highlight about the half vector of the directions to light and eye (Blinn 1977).
///
/// Its BRDF is colour / π + specular · N cosⁿβ, with the exponent n, the angle β between the normal and the half
/// vector, and N = (n + 2)(n + 4) / (8π(n + 2^(−n/2))), for which the highlight's albedo at normal incidence is exactly
/// `specular` (Giesen, "Phong Normalization Factor derivation", 2009).
/// In each channel colour and specular add up to at most 1.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BlinnPhong {
    /// Albedo of the diffuse term, linear Rec. 709, each component from 0 to 1.
    pub colour: Rgb,
    /// Largest albedo of the highlight, linear Rec. 709, each component from 0 to 1.
    pub specular: Rgb,
    /// The exponent, from 0 to 1e9; a larger one makes the highlight smaller and brighter, and about four times a Phong
    /// exponent gives the same width.
    pub exponent: f64,
}

impl Default for BlinnPhong {
    fn default() -> Self {
        Self { colour: Rgb::grey(0.4), specular: Rgb::grey(0.2), exponent: 200.0 }
    }
}
