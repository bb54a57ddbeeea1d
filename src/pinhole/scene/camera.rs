use super::{Degrees, Placement, Resolution};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// Across what a camera's field of view is measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum FovAxis {
    /// From the bottom edge to the top edge.
    #[default]
    Vertical,
    /// From the left edge to the right edge.
    Horizontal,
    /// Across the shorter side of the image.
    Smaller,
    /// Across the longer side of the image.
    Larger,
    /// From corner to corner.
    Diagonal,
}

/// A pinhole camera: every ray starts at the eye and passes through a point of the image plane before it.
///
/// A larger angle sees more and shows each thing smaller.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement, Resolution)]
pub struct PerspectiveCamera {
    /// The full angle, strictly between 0° and 180°.
    pub fov: Degrees,
    /// Across what the angle is measured.
    pub axis: FovAxis,
}

impl Default for PerspectiveCamera {
    fn default() -> Self {
        Self { fov: Degrees(45.0), axis: FovAxis::Vertical }
    }
}

/// A camera of parallel rays, each starting on the rectangle that the image is.
///
/// A larger view height sees more; distance changes no thing's size.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement, Resolution)]
pub struct OrthographicCamera {
    /// The height of the rectangle in scene units, above 0.
    pub view_height: f64,
}

impl Default for OrthographicCamera {
    fn default() -> Self {
        Self { view_height: 2.0 }
    }
}
