use super::{Placement, Resolution};
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A camera that sees all directions: longitude grows linearly to the right, and latitude falls linearly downward.
///
/// The centre of the image is straight ahead, its left and right edges straight behind, its upper edge straight up.
/// An image twice as wide as it is high has square pixels at its centre; a picture taken by this camera can serve as an
/// [`Environment`](super::Environment) map.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[require(Placement, Resolution)]
pub struct EquirectangularCamera;
