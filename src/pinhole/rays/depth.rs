use super::{Paths, PixelSamples, Tile};
use bevy_ecs::prelude::*;

/// On a tile's entity: the depth of its rays, which is the number of bounces before them; 0 for camera rays.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Depth(pub u32);

/// The pixel of the image that a row of a tile belongs to, and whose random numbers it therefore uses.
#[inline(always)]
pub fn pixel_of_row(tile: &Tile, samples: Option<&PixelSamples>, paths: Option<&Paths>, row: usize) -> [u32; 2] {
    let first = paths.map_or(row, |paths| paths.first[row] as usize);
    tile.pixel_of(samples.map_or(first, |samples| samples.pixel[first] as usize))
}
