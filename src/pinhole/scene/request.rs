use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On the camera: paint this column instead of the picture.
///
/// Stages that the column does not need are left out.
#[derive(Component, Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct View {
    /// The column's word, such as `ndc`.
    pub column: String,
}

/// On the camera: count every stage's rows and take its time.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Statistics;

/// A pixel whose way to light someone wants to follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TracePixel {
    /// Columns from the left, from 0.
    pub x: u32,
    /// Rows from the top, from 0.
    pub y: u32,
}
