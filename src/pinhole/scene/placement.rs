use super::orientation::WrittenPlacement;
use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// The transform from an entity's own space to its parent's, or to the world's: scale, then rotation, then translation.
///
/// A scene file may give the orientation by angles instead: as `euler_xyz`, three angles in degrees, see
/// [`euler_xyz`](super::euler_xyz), or as `axis_angle: (axis: (0, 1, 0), angle: 90)`.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "WrittenPlacement")]
pub struct Placement {
    /// The origin of the entity's space, in scene units.
    pub position: DVec3,
    /// The rotation from the entity's axes to its parent's, a quaternion (x, y, z, w) of any length but 0, which is
    /// normalised.
    #[serde(skip_serializing_if = "unturned")]
    pub orientation: DQuat,
    /// The scale factors along the entity's own axes; a negative one mirrors, 0 is an error.
    #[serde(skip_serializing_if = "unscaled")]
    pub scale: DVec3,
}

impl Default for Placement {
    fn default() -> Self {
        Self { position: DVec3::ZERO, orientation: DQuat::IDENTITY, scale: DVec3::ONE }
    }
}

impl Placement {
    /// A translation to a point, without rotation or scale.
    pub fn at(x: f64, y: f64, z: f64) -> Self {
        Self { position: DVec3::new(x, y, z), ..Self::default() }
    }
}

/// Stands at `eye` and looks at `target`; it overrides the position and orientation of the [`Placement`].
///
/// `up` need not be perpendicular to the viewing direction, only not parallel to it. Left at its default it may be: straight
/// down the top of the image is then towards −z, and straight up towards z, as if a camera that looked along −z had been
/// tilted.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct LookAt {
    /// The position, in scene units.
    pub eye: DVec3,
    /// The point looked at, distinct from `eye`.
    pub target: DVec3,
    /// A direction that points upward in the image.
    #[serde(skip_serializing_if = "up_is_y")]
    pub up: DVec3,
}

impl Default for LookAt {
    fn default() -> Self {
        Self { eye: DVec3::ZERO, target: DVec3::NEG_Z, up: DVec3::Y }
    }
}

fn unturned(orientation: &DQuat) -> bool {
    same_bits(orientation.to_array(), DQuat::IDENTITY.to_array())
}

fn unscaled(scale: &DVec3) -> bool {
    same_bits(scale.to_array(), DVec3::ONE.to_array())
}

fn up_is_y(up: &DVec3) -> bool {
    same_bits(up.to_array(), DVec3::Y.to_array())
}

/// Whether a file may leave one out and mean the other; −0 and 0 differ here.
fn same_bits<const N: usize>(one: [f64; N], other: [f64; N]) -> bool {
    one.map(f64::to_bits) == other.map(f64::to_bits)
}
