use super::random::{Rows, draw_one};
use super::{PixelSamples, RasterPoints, SampleNumber, Tile};
use crate::extract::{SamplingTable, ShutterTable, motion_evidence};
use crate::plan::{Column, Shared, Stage, TileSystems, column};
use crate::sample::Purpose;
use bevy_ecs::prelude::*;

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
        let rows = Rows { sampling: &sampling, tile, number, samples };
        let times = times.slices_mut(raster.rows());
        draw_one(rows, Purpose::Time, times);
        times.iter_mut().for_each(|time| *time *= shutter.length);
    }
}

/// The stage that runs this system.
pub fn time_stage() -> Stage {
    Stage::new("Sample times", TileSystems::Lens, draw_times).when(motion_evidence)
}
