use super::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A surface that shines by itself, equally in all directions.
///
/// It may stand beside a material or alone; a shape with an `Emissive` alone reflects nothing.
/// Put it on the shape, or on the entity whose material the shape uses; the shape's own goes first.
/// What it emits is seen; it lights other surfaces where the camera's [`Integrator`](super::Integrator) follows light so
/// far.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Emissive {
    /// The radiance that leaves every point, linear Rec. 709, each part finite and at least 0.
    pub radiance: Rgb,
    /// Which sides of the surface shine.
    #[serde(skip_serializing_if = "Sides::are_both")]
    pub sides: Sides,
}

/// Which sides of a surface something is true of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Sides {
    /// Either.
    #[default]
    Both,
    /// The side of the shape's own normal: a plane's `normal`, the entity's +y for a disk and a rectangle, the side from
    /// which a triangle's corners go round anticlockwise or to which its normals point; the outside of a sphere or cuboid.
    Front,
}

impl Sides {
    /// Whether it is both.
    pub fn are_both(&self) -> bool {
        *self == Self::Both
    }
}

impl Default for Emissive {
    fn default() -> Self {
        Self { radiance: Rgb::grey(1.0), sides: Sides::Both }
    }
}
