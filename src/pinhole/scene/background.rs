use super::Rgb;
use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// A constant environment: the radiance along rays that hit nothing; black if the scene has none.
///
/// At most one entity may have it, and only if the scene has neither a [`Gradient`](super::Gradient) nor an
/// [`Environment`](super::Environment).
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Background {
    /// Radiance in linear Rec. 709, each component finite and at least 0.
    pub colour: Rgb,
}
