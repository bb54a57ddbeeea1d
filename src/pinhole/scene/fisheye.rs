use super::{Degrees, FovAxis, Placement, Resolution};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A camera whose image is a circle in which equal steps from the centre are equal angles from the axis (equidistant).
///
/// It sees up to all directions at once; what lies outside its circle is black.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement, Resolution)]
pub struct FisheyeCamera {
    /// The full angle across the circle, above 0° and at most 360°.
    pub fov: Degrees,
    /// Across what of the image the circle reaches.
    pub axis: FovAxis,
}

impl Default for FisheyeCamera {
    fn default() -> Self {
        Self { fov: Degrees(180.0), axis: FovAxis::Smaller }
    }
}
