use super::{PixelSamples, Tile};
use bevy_ecs::prelude::*;

/// On a tile's entity: which leg of the light's way its rays are on, counted from the one to the eye, which is 0.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Leg(pub u32);

/// The pixel of the image that a row of a tile belongs to, and so whose random numbers it has.
#[inline(always)]
pub fn pixel_of_row(tile: &Tile, samples: Option<&PixelSamples>, row: usize) -> [u32; 2] {
    tile.pixel_of(samples.map_or(row, |samples| samples.pixel[row] as usize))
}
