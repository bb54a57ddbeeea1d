//! The reader's function in the picture of chapter 17: samples through a tent filter.

use super::question::Input;
use bevy_ecs::prelude::*;
use pinhole::extract::{FilterTable, SamplingTable, radius_of};
use pinhole::plan::{Column, Shared};
use pinhole::rays;
use pinhole::rays::{Depth, Draws, PixelSamples, RasterPoints, SampleNumber, Tile, draws_of_two};
use pinhole::sample::Purpose;
use pinhole_lab::exercise::{Ask, Setting, StandIn};

/// Samples placed by the tent, with the radius of the filter that the camera has.
pub fn mine(ask: Ask<Input, f64>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        rays::place_samples_stage,
        move |(sampling, filter): (Res<Shared<SamplingTable>>, Res<Shared<FilterTable>>),
              (mut rows, mut points): (Local<Vec<u32>>, Local<Vec<[f64; 2]>>),
              mut tiles: Query<(&Tile, Option<&SampleNumber>, &PixelSamples, &mut RasterPoints)>| {
            let radius = radius_of(filter.filter);
            for (tile, number, samples, mut raster) in &mut tiles {
                rows.clear();
                rows.extend(0..raster.rows() as u32);
                let draws =
                    Draws { sampling: &sampling, tile, number, samples: Some(samples), paths: None, depth: Depth(0) };
                draws_of_two(&draws, Purpose::Pixel, &rows, &mut points);
                for (row, &[right, down]) in points.iter().enumerate() {
                    let [x, y] = tile.pixel_of(samples.pixel[row] as usize).map(|at| f64::from(at) + 0.5);
                    let place = (tile, Some(samples), None);
                    let offsets = [right, down].map(|u| ask.at(place, row, (u, radius)));
                    if let [Some(right), Some(down)] = offsets {
                        (raster.x[row], raster.y[row]) = (x + right, y + down);
                    }
                }
            }
        },
    )
}
