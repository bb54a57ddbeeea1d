use super::{Paths, PixelSamples, Tile};
use bevy_ecs::prelude::*;

/// On a tile's entity: which leg of light's way its rays are; 0 is the one from the camera.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Depth(pub u32);

/// The pixel of the image that a row of a tile belongs to, and so whose random numbers it has.
#[inline(always)]
pub fn pixel_of_row(tile: &Tile, samples: Option<&PixelSamples>, paths: Option<&Paths>, row: usize) -> [u32; 2] {
    let first = paths.map_or(row, |paths| paths.first[row] as usize);
    tile.pixel_of(samples.map_or(first, |samples| samples.pixel[first] as usize))
}
