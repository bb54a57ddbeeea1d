use super::{Placement, Resolution};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A camera that sees all directions: to the right in equal steps of longitude, down in equal steps of latitude.
///
/// The middle of the image is straight ahead, its left and right edges straight behind, its upper edge straight up.
/// An image twice as wide as high has pixels as wide as high at its middle; what it shows of a scene is an environment
/// image of it.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[require(Placement, Resolution)]
pub struct EquirectangularCamera;
