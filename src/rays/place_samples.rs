use super::{RasterPoints, Tile};
use crate::extract::SamplingTable;
use crate::plan::{Evidence, Shared, Stage, StageKind, TileSystems, column};
use crate::sample::{Purpose, uniform};
use crate::scene::Sampling;
use bevy_ecs::prelude::*;

column! {
    /// Which sample of which pixel each row is; exists where a camera takes several.
    pub struct PixelSamples("samples", "film", "rows and counts", Pixel) {
        /// The row of the tile's film.
        pixel: u32,
        /// The sample's number within its pixel.
        sample: u32,
    }
}

impl PixelSamples {
    /// Grey, by the sample's number.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.sample[row] as f32 / (1.0 + self.sample[row] as f32); 3]
    }
}

/// On a tile's entity: which sample of each pixel runs next.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SampleNumber(pub u32);

/// On a tile's entity: the rows of its film that take part in the next run, ascending.
#[derive(Component, Clone, Debug, Default, PartialEq, Eq)]
pub struct ActivePixels(pub Vec<u32>);

/// Fills a tile's raster points with one sample of each of its active pixels.
pub fn place_samples(
    sampling: Res<Shared<SamplingTable>>,
    mut tiles: Query<(&Tile, &SampleNumber, &ActivePixels, &mut RasterPoints, &mut PixelSamples)>,
) {
    for (tile, &SampleNumber(number), ActivePixels(active), mut raster, mut samples) in &mut tiles {
        let rows = active.len();
        let (xs, ys) = raster.slices_mut(rows);
        let (of_pixel, sample) = samples.slices_mut(rows);
        for (row, &film_row) in active.iter().enumerate() {
            let pixel = tile.pixel_of(film_row as usize);
            xs[row] = f64::from(pixel[0]) + uniform(sampling.seed, pixel, number, Purpose::PixelX);
            ys[row] = f64::from(pixel[1]) + uniform(sampling.seed, pixel, number, Purpose::PixelY);
            (of_pixel[row], sample[row]) = (film_row, number);
        }
    }
}

/// The stage on offer: the alternative to raster points in the middle of their pixels.
pub fn place_samples_stage() -> Stage {
    Stage::new("Place samples", TileSystems::Raster, place_samples)
        .kind(StageKind::Alternative)
        .writes::<RasterPoints>()
        .writes::<PixelSamples>()
        .table::<SamplingTable>()
        .when(sampling_evidence)
}

/// Evidence that the camera takes several samples a pixel, or one at random.
pub fn sampling_evidence(scene: &World) -> Evidence {
    Evidence::of::<Sampling>(scene, "sampling camera")
}
