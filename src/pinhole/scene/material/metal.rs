use crate::scene::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A rough conductor: microfacets with a GGX (Trowbridge–Reitz) distribution of normals.
///
/// A larger roughness blurs more; light that would hit a second microfacet is lost unless `multiple_scattering` is set.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Metal {
    /// The reflectance of each microfacet, the same at all angles, linear Rec. 709, each component from 0 to 1.
    pub colour: Rgb,
    /// GGX's α, from 0 to 1; below 0.001 the surface is a perfect mirror.
    pub roughness: f64,
    /// Whether light scattered by several microfacets is included; if not, rough metal is too dark, at α = 1 by up to
    /// 69 %.
    pub multiple_scattering: bool,
}

impl Default for Metal {
    fn default() -> Self {
        Self { colour: Rgb::grey(0.9), roughness: 0.2, multiple_scattering: false }
    }
}
