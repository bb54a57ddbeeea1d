//! The components that are materials; a new one has a word here.

use super::file::Word;
use crate::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A matte surface (diffuse, Lambertian): its BRDF is the constant colour / π.
///
/// Put it on the shape itself, or on a separate entity that shapes refer to through [`UsesMaterial`].
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Matte {
    /// Its albedo, linear Rec. 709, each component from 0 to 1.
    pub colour: Rgb,
}

impl Default for Matte {
    fn default() -> Self {
        Self { colour: Rgb::grey(0.5) }
    }
}

/// The shape on this entity has the material of that one.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq)]
#[relationship(relationship_target = UsedByShapes)]
pub struct UsesMaterial(pub Entity);

/// The shapes that use this entity's material; maintained by `bevy_ecs`, never written by an author.
#[derive(Component, Debug, Default)]
#[relationship_target(relationship = UsesMaterial)]
pub struct UsedByShapes(Vec<Entity>);

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

/// A perfect mirror: a specular reflector, whose BRDF is a delta distribution about the mirrored direction.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Mirror {
    /// Its reflectance, the same at all angles, linear Rec. 709, each component from 0 to 1.
    pub colour: Rgb,
}

impl Default for Mirror {
    fn default() -> Self {
        Self { colour: Rgb::grey(0.9) }
    }
}

/// A smooth dielectric: light is specularly reflected and refracted, in the proportion that Fresnel's equations give.
///
/// The shape must be closed, or divide all of space in two; glass fills the side that its normal points away from.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Glass {
    /// The index of refraction relative to vacuum, above 0; a higher one bends light more.
    pub ior: f64,
    /// The absorption coefficient per scene unit: by Beer's law e^(−absorption · length) is transmitted; each component
    /// at least 0.
    pub absorption: Rgb,
    /// Where dielectrics overlap, the one of highest priority fills the space.
    pub priority: u32,
}

impl Default for Glass {
    fn default() -> Self {
        Self { ior: 1.5, absorption: Rgb::BLACK, priority: 0 }
    }
}

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

/// A rough dielectric, such as frosted glass: microfacets with a GGX (Trowbridge–Reitz) distribution of normals, each of
/// which reflects and refracts as smooth glass does.
///
/// The shape must be closed, or divide all of space in two; glass fills the side that its normal points away from.
/// Light that would hit a second microfacet is lost.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RoughGlass {
    /// The index of refraction relative to vacuum, from 0.001 to 1000; a higher one bends light more.
    pub ior: f64,
    /// GGX's α, from 0 to 1; below 0.001 the surface is smooth glass.
    pub roughness: f64,
    /// The absorption coefficient per scene unit: by Beer's law e^(−absorption · length) is transmitted; each component
    /// at least 0.
    pub absorption: Rgb,
    /// Where dielectrics overlap, the one of highest priority fills the space.
    pub priority: u32,
}

impl Default for RoughGlass {
    fn default() -> Self {
        Self { ior: 1.5, roughness: 0.2, absorption: Rgb::BLACK, priority: 0 }
    }
}

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

/// A thin pane of smooth glass, as of a window: a surface without an interior, which light crosses without being bent.
///
/// It stands for both faces of the pane and all reflections between them, so that any shape may be made of it, open or
/// closed.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ThinGlass {
    /// The index of refraction of the glass, from 1 to 1000; a higher one reflects more.
    pub ior: f64,
    /// The factor of the light that is transmitted, linear Rec. 709, each component from 0 to 1.
    pub colour: Rgb,
}

impl Default for ThinGlass {
    fn default() -> Self {
        Self { ior: 1.5, colour: Rgb::grey(1.0) }
    }
}

/// Whether an entity has a material of its own.
pub(super) fn is_material(entity: EntityRef<'_>) -> bool {
    MATERIALS.iter().any(|word| entity.contains_type_id((word.kind)()))
}

/// Every component that is a material, with its word in scene files.
pub(super) const MATERIALS: &[Word] = &[
    Word::of::<Matte>("matte"),
    Word::of::<Phong>("phong"),
    Word::of::<BlinnPhong>("blinn_phong"),
    Word::of::<Mirror>("mirror"),
    Word::of::<Glass>("glass"),
    Word::of::<Metal>("metal"),
    Word::of::<RoughGlass>("rough_glass"),
    Word::of::<Principled>("principled"),
    Word::of::<ThinGlass>("thin_glass"),
];
