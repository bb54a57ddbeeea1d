use super::{Degrees, Placement, Resolution};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// Across which extent of the image a camera's field of view is measured (Mitsuba's `fov_axis`).
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

/// A pinhole camera: every ray starts at the eye and passes through a point of the image plane in front of it.
///
/// A larger field of view sees more and shows each object smaller.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement, Resolution)]
pub struct PerspectiveCamera {
    /// The full field of view, strictly between 0° and 180°.
    pub fov: Degrees,
    /// The extent across which it is measured.
    pub axis: FovAxis,
}

impl Default for PerspectiveCamera {
    fn default() -> Self {
        Self { fov: Degrees(45.0), axis: FovAxis::Vertical }
    }
}

/// An orthographic camera: parallel rays that start on a rectangle, the image itself.
///
/// A larger view height sees more; distance does not change the size of objects.
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
