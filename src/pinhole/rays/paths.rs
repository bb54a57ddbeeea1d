//! What is kept of a path.

use super::draws::{Draws, draw_one};
use super::{PixelSamples, RasterPoints, SampleNumber, Tile};
use crate::each::Each;
use crate::extract::{SamplingTable, ShutterTable, motion_evidence};
use crate::plan::{Column, Shared, Stage, TileSystems, column};
use crate::sample::Purpose;
use bevy_ecs::prelude::*;

column! {
    /// The path that each ray belongs to: its pixel, its throughput, and the pdf of its last direction.
    pub struct Paths("path", "light", "throughput, 1/sr", Path, begun in Start) {
        /// The row of the path's camera ray.
        first: u32,
        /// The throughput: the factor by which radiance along this ray contributes to the film.
        throughput: [f64; 3] as [r, g, b],
        /// The pdf, per solid angle, with which BSDF sampling chose this direction; infinite for camera rays and after
        /// specular bounces (a delta distribution).
        pdf: f64,
    }
}

impl Paths {
    /// Paints the throughput.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.throughput(row).each(|component| component as f32)
    }
}

column! {
    /// The radiance that each path has contributed to the film so far.
    pub struct PathLight("path light", "light", "linear Rec. 709", Path, begun in Start) {
        /// Red, green and blue.
        rgb: [f64; 3] as [r, g, b],
    }
}

impl PathLight {
    /// Paints the radiance.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.rgb(row).each(|component| component as f32)
    }
}

/// On a tile's entity: the depth of its rays, which is the number of bounces before them; 0 for camera rays.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Depth(pub u32);

/// The pixel of the image that a row of a tile belongs to, and whose random numbers it therefore uses.
#[inline(always)]
pub fn pixel_of_row(tile: &Tile, samples: Option<&PixelSamples>, paths: Option<&Paths>, row: usize) -> [u32; 2] {
    let first = paths.map_or(row, |paths| paths.first[row] as usize);
    tile.pixel_of(samples.map_or(first, |samples| samples.pixel[first] as usize))
}

column! {
    /// The time of each ray, which is that of its whole path.
    pub struct RayTimes("time", "since the shutter opened", "units of time", Ray, begun in Lens) {
        /// In [0, the duration for which the shutter is open).
        time: f64,
    }
}

impl RayTimes {
    /// Paints the time as grey: black when the shutter opens, mid-grey after one unit of time.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [(self.time[row] / (1.0 + self.time[row])) as f32; 3]
    }
}

/// Samples the time of each of a tile's rays.
pub fn draw_times(
    shutter: Res<Shared<ShutterTable>>,
    sampling: Res<Shared<SamplingTable>>,
    mut tiles: Query<(&Tile, Option<&SampleNumber>, Option<&PixelSamples>, &RasterPoints, &mut RayTimes)>,
) {
    for (tile, number, samples, raster, mut times) in &mut tiles {
        let draws = Draws { sampling: &sampling, tile, number, samples, paths: None, depth: Depth(0) };
        let times = times.slices_mut(raster.rows());
        draw_one(&draws, Purpose::Time, times);
        times.iter_mut().for_each(|time| *time *= shutter.length);
    }
}

/// The stage that runs this system.
pub fn time_stage() -> Stage {
    Stage::new("Sample times", TileSystems::Lens, draw_times).when(motion_evidence)
}
