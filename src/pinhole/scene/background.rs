use super::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// The radiance that a ray which meets nothing brings back; black where a scene has none.
///
/// At most one entity may carry it, and none together with a [`Gradient`](super::Gradient) or an
/// [`Environment`](super::Environment).
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Background {
    /// Linear Rec. 709 radiance, each part finite and at least 0.
    pub colour: Rgb,
}
