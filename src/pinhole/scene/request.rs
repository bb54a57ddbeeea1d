use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On the camera: paint this column instead of the picture.
///
/// Stages that the column does not need are left out.
#[derive(Component, Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct View {
    /// The column's name, such as `ndc`.
    pub column: String,
}

/// On the camera: count the rows that every stage processes, and measure its time.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Statistics;

/// A pixel to be traced: every column of its row is recorded, stage by stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TracePixel {
    /// The pixel's column, from 0 at the left.
    pub x: u32,
    /// The pixel's row, from 0 at the top.
    pub y: u32,
}
