use super::{Degrees, FovAxis, Placement, Resolution};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// An equidistant fisheye camera: the distance from the centre of its circular image is proportional to the angle from
/// the viewing axis.
///
/// It sees up to the full sphere of directions; pixels outside the circle are black.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement, Resolution)]
pub struct FisheyeCamera {
    /// The full field of view across the circle, above 0° and at most 360°.
    pub fov: Degrees,
    /// The extent of the image that the circle's diameter equals.
    pub axis: FovAxis,
}

impl Default for FisheyeCamera {
    fn default() -> Self {
        Self { fov: Degrees(180.0), axis: FovAxis::Smaller }
    }
}
