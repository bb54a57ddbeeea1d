use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// Where an entity stands: its own space is scaled, turned, then moved into its parent's, or the world's.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Placement {
    /// The origin of the entity's space, in scene units.
    pub position: DVec3,
    /// The turn from the entity's axes to its parent's, a unit quaternion.
    #[serde(skip_serializing_if = "unturned")]
    pub orientation: DQuat,
    /// Stretch along the entity's own axes; negative mirrors, 0 is refused.
    #[serde(skip_serializing_if = "unscaled")]
    pub scale: DVec3,
}

impl Default for Placement {
    fn default() -> Self {
        Self { position: DVec3::ZERO, orientation: DQuat::IDENTITY, scale: DVec3::ONE }
    }
}

impl Placement {
    /// Moved to a point, neither turned nor scaled.
    pub fn at(x: f64, y: f64, z: f64) -> Self {
        Self { position: DVec3::new(x, y, z), ..Self::default() }
    }
}

/// Stands at `eye` and looks at `target`; it takes the place of the [`Placement`]'s position and orientation.
///
/// `up` need not be perpendicular to the view, only not along it.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct LookAt {
    /// Where it stands, in scene units.
    pub eye: DVec3,
    /// A point it looks at, apart from `eye`.
    pub target: DVec3,
    /// A direction that shall point upward in the image.
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

/// Whether a file may leave the one out and mean the other: −0 is not 0 here.
fn same_bits<const N: usize>(one: [f64; N], other: [f64; N]) -> bool {
    one.map(f64::to_bits) == other.map(f64::to_bits)
}
