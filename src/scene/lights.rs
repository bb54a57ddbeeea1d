//! The components that are lights.

use super::{Degrees, Placement, Rgb};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A point light at the entity's position, which emits equally in all directions.
///
/// The irradiance on a surface that faces it at distance d is intensity / d².
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct PointLight {
    /// Radiant intensity, linear Rec. 709, each component finite and at least 0.
    pub intensity: Rgb,
    /// Whether objects cast shadows in its light; if not, no shadow rays are traced for it.
    pub casts_shadows: bool,
}

impl Default for PointLight {
    fn default() -> Self {
        Self { intensity: Rgb::grey(1.0), casts_shadows: true }
    }
}

/// A light so distant that its rays are parallel, as sunlight is (a delta distribution over directions).
///
/// They travel along the entity's own −z, which a [`LookAt`](super::LookAt) points from its eye to its target; the
/// entity's position has no effect.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct DirectionalLight {
    /// The irradiance on a surface that faces the light, linear Rec. 709, each component finite and at least 0.
    pub irradiance: Rgb,
    /// Whether objects cast shadows in its light; if not, no shadow rays are traced for it.
    pub casts_shadows: bool,
}

impl Default for DirectionalLight {
    fn default() -> Self {
        Self { irradiance: Rgb::grey(1.0), casts_shadows: true }
    }
}

/// A spotlight: a point light at the entity's position that emits into a cone about the entity's own −z.
///
/// Within the inner cone its intensity is full; from there to the outer cone it falls off smoothly in the cosine (the
/// smoothstep of *Physically Based Rendering*, 4th edition, section 12.2); outside it is zero.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct SpotLight {
    /// Radiant intensity along the axis, linear Rec. 709, each component finite and at least 0.
    pub intensity: Rgb,
    /// The full angle across the inner cone, from 0 to the outer angle.
    pub inner_angle: Degrees,
    /// The full angle across the outer cone, above 0° and up to 180°, which is a half-space.
    pub outer_angle: Degrees,
    /// Whether objects cast shadows in its light; if not, no shadow rays are traced for it.
    pub casts_shadows: bool,
}

impl Default for SpotLight {
    fn default() -> Self {
        let (inner_angle, outer_angle) = (Degrees(40.0), Degrees(60.0));
        Self { intensity: Rgb::grey(1.0), inner_angle, outer_angle, casts_shadows: true }
    }
}

/// A diffuse emitter: a surface that emits the same radiance in all directions.
///
/// It may stand beside a material or alone; a shape with nothing but an `Emissive` reflects no light.
/// Put it on the shape, or on the entity whose material the shape uses; the shape's own takes precedence.
/// The camera always sees what it emits; it illuminates other surfaces if the camera's
/// [`Integrator`](super::Integrator) simulates that.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Emissive {
    /// The radiance emitted at every point, linear Rec. 709, each component finite and at least 0.
    pub radiance: Rgb,
    /// Which sides of the surface emit.
    #[serde(skip_serializing_if = "Sides::are_both")]
    pub sides: Sides,
}

/// One side of a surface or both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Sides {
    /// Both sides.
    #[default]
    Both,
    /// The side that the shape's own normal points to: a plane's `normal`, the entity's +y for a disk and a rectangle,
    /// the outside of a sphere or cuboid, and for a triangle the side to which its vertex normals point or, without
    /// them, the one from which its vertices run anticlockwise.
    Front,
}

impl Sides {
    /// Whether it is [`Both`](Self::Both).
    pub fn are_both(&self) -> bool {
        *self == Self::Both
    }
}

impl Default for Emissive {
    fn default() -> Self {
        Self { radiance: Rgb::grey(1.0), sides: Sides::Both }
    }
}
