use crate::scene::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// The metallic–roughness material of glTF 2.0: a dielectric over a diffuse base, a metal, or a mixture of both.
///
/// No energy is lost between microfacets: what single scattering loses is given back.
/// A texture on the same entity gives it its base colour; an `Emissive` makes it shine.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Principled {
    /// The diffuse albedo of the dielectric and the reflectance of the metal at normal incidence, linear Rec. 709, each
    /// component from 0 to 1.
    pub base_colour: Rgb,
    /// 0 for a dielectric, 1 for a metal; in between the two are mixed.
    pub metallic: f64,
    /// The perceived roughness, from 0 to 1: its square is GGX's α, which is at least 0.001.
    pub roughness: f64,
    /// The index of refraction of the dielectric, from 1 to 1e9, which reflects ((ior − 1)/(ior + 1))² at normal
    /// incidence: 4 % for 1.5.
    #[serde(skip_serializing_if = "is_usual")]
    pub ior: f64,
    /// How much of the surface is under a clear coat of index 1.5, from 0 to 1.
    #[serde(skip_serializing_if = "is_none")]
    pub coat: f64,
    /// The perceived roughness of the coat, from 0 to 1.
    #[serde(skip_serializing_if = "is_none")]
    pub coat_roughness: f64,
}

/// The index of refraction that a scene file need not write.
const USUAL: f64 = 1.5;

fn is_usual(ior: &f64) -> bool {
    *ior == USUAL
}

fn is_none(factor: &f64) -> bool {
    *factor == 0.0
}

impl Default for Principled {
    fn default() -> Self {
        Self { base_colour: Rgb::grey(0.8), metallic: 0.0, roughness: 0.5, ior: USUAL, coat: 0.0, coat_roughness: 0.0 }
    }
}
