//! The components that are cameras, and the lens of one.

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

/// A camera that sees all directions: longitude grows linearly to the right, and latitude falls linearly downward.
///
/// The centre of the image is straight ahead, its left and right edges straight behind, its upper edge straight up.
/// An image twice as wide as it is high has square pixels at its centre; a picture taken by this camera can serve as an
/// [`Environment`](super::Environment) map.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[require(Placement, Resolution)]
pub struct EquirectangularCamera;

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
