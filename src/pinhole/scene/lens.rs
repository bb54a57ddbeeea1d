use super::Degrees;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On a perspective camera: a thin lens in place of the pinhole, so that only objects at one distance are in focus.
///
/// Each ray starts at a random point of the aperture and passes through the point where the pinhole's ray would hit the
/// plane of focus; a point in front of or behind that plane is spread over a disk, the circle of confusion.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Lens {
    /// The size of the aperture.
    pub aperture: Aperture,
    /// The distance from the eye to the plane of focus, along the viewing axis, in scene units.
    pub focus_distance: f64,
    /// The number of straight edges of the aperture, 3 to 64; 0 for a round one.
    pub blades: u32,
    /// The aperture's rotation, anticlockwise as seen from behind the camera; at 0° a corner points to the right.
    pub turn: Degrees,
}

/// The size of a lens's aperture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Aperture {
    /// By its radius; if it has straight edges, the distance of their corners from the centre.
    Radius {
        /// In scene units, at least 0; 0 is a pinhole.
        radius: f64,
    },
    /// By its f-number, the focal length over the aperture's diameter, so that the radius is
    /// `focal_length` / (2 `number`).
    ///
    /// The focal length serves for this alone: the field of view is that of the camera.
    FNumber {
        /// The f-number N of f/N, above 0.
        number: f64,
        /// The lens's focal length in scene units: 0.05 for a lens of 50 mm where a scene unit is a metre.
        focal_length: f64,
    },
}

impl Default for Aperture {
    fn default() -> Self {
        Self::Radius { radius: 0.05 }
    }
}

impl Default for Lens {
    fn default() -> Self {
        Self { aperture: Aperture::default(), focus_distance: 5.0, blades: 0, turn: Degrees(0.0) }
    }
}
