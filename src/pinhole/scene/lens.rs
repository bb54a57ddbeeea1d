use super::Degrees;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On a perspective camera: an opening in place of the pinhole, so that only what lies at one distance is sharp.
///
/// Each ray starts somewhere on the opening and passes through the point that the pinhole's ray has on the plane in
/// focus; what is before or behind that plane is spread over a disk the wider the farther off it is.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Lens {
    /// How wide the opening is.
    pub aperture: Aperture,
    /// From the eye to the plane in focus, along the direction in which the camera looks, in scene units.
    pub focus_distance: f64,
    /// The opening's straight edges, 3 to 64; 0 for a round one.
    pub blades: u32,
    /// How far the edges are turned, anticlockwise as seen from behind the camera; at 0° a corner points to the right.
    pub turn: Degrees,
}

/// How wide the opening of a lens is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Aperture {
    /// By its radius; where it has edges, the distance of its corners from the centre.
    Radius {
        /// In scene units, at least 0; 0 is a pinhole.
        radius: f64,
    },
    /// As photographers do: the focal length over the opening's diameter, so that the radius is
    /// `focal_length` / (2 `number`).
    ///
    /// The focal length serves for this alone: the field of view is the camera's own.
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
