use super::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

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
