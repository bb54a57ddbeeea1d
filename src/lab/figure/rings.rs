//! One scene through samples that beat with it, and through samples that cannot.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::Picture;
use super::svg::Drawing;
use crate::naive::sampling::grid_place;
use bevy_ecs::prelude::*;
use pinhole::Chapter;
use pinhole::Result;
use pinhole::plan::{Stage, StageKind, TileSystems};
use pinhole::rays::{ActivePixels, PixelSamples, RasterPoints, SampleNumber, Tile, raster_stage};
use pinhole::scene::{Filter, Sampler, Sampling};

/// Samples along each axis of a pixel.
const SIDE: u32 = 4;
const SIZE: [u32; 2] = [276, 184];

/// The centre alone; a grid; as many points of a Sobol sequence.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let sampled = |sampler| Sampling { samples: SIDE * SIDE, seed: 17, sampler, filter: Filter::BOX };
    let lines = |one: &str, two: &str| vec![one.to_owned(), two.to_owned()];
    let centre = Picture::of(chapter, SIZE, Some(raster_stage()), |camera| {
        camera.remove::<Sampling>();
    })?;
    let grid = Picture::of(chapter, SIZE, Some(grid_stage()), |camera| {
        camera.insert(sampled(Sampler::Independent));
    })?;
    let sobol = Picture::of(chapter, SIZE, None, |camera| {
        camera.insert(sampled(Sampler::Sobol));
    })?;
    let exhibits = [
        Exhibit { picture: centre, lines: lines("the centre", "1 sample") },
        Exhibit { picture: grid, lines: lines("a grid, in every pixel the same", "16 samples") },
        Exhibit { picture: sobol, lines: lines("Sobol, scrambled for each pixel", "16 samples") },
    ];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}

fn place_on_grid(mut tiles: Query<(&Tile, &SampleNumber, &ActivePixels, &mut RasterPoints, &mut PixelSamples)>) {
    for (tile, &SampleNumber(number), ActivePixels(active), mut raster, mut samples) in &mut tiles {
        let [xs, ys] = raster.slices_mut(active.len());
        let (pixels, numbers) = samples.slices_mut(active.len());
        pixels.copy_from_slice(active);
        numbers.fill(number);
        let place = grid_place(number, SIDE);
        for (&row, (x, y)) in active.iter().zip(xs.iter_mut().zip(ys)) {
            let pixel = tile.pixel_of(row as usize);
            (*x, *y) = (f64::from(pixel[0]) + place[0], f64::from(pixel[1]) + place[1]);
        }
    }
}

fn grid_stage() -> Stage {
    Stage::new("Place samples on a grid", TileSystems::Raster, place_on_grid).kind(StageKind::Alternative)
}
