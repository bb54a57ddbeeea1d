use super::{RasterPoints, Tile};
use crate::extract::{FilterTable, SamplingTable};
use crate::plan::{Evidence, Shared, Stage, StageKind, TileSystems, column};
use crate::sample::{
    Draw, Independent, PixelKey, Purpose, Sobol, Stratified, box_offset, table_offset, tent_offset, unit,
};
use crate::scene::{Filter, Sampler, Sampling};
use bevy_ecs::prelude::*;
use multiversion::multiversion;

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

column! {
    /// What each row's sample counts for; exists where the filter is negative in places.
    pub struct SampleSigns("sign", "film", "1 or −1", Pixel) {
        /// 1, or −1 where the filter is negative.
        sign: f32,
    }
}

impl SampleSigns {
    /// White for 1, red for −1.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        if self.sign[row] < 0.0 { [1.0, 0.0, 0.0] } else { [1.0; 3] }
    }
}

/// On a tile's entity: which sample of each pixel runs next.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SampleNumber(pub u32);

/// On a tile's entity: the rows of its film that take part in the next run, ascending.
#[derive(Component, Clone, Debug, Default, PartialEq, Eq)]
pub struct ActivePixels(pub Vec<u32>);

// ANCHOR: place_samples
/// Fills a tile's raster points with one sample of each of its active pixels.
pub fn place_samples(
    sampling: Res<Shared<SamplingTable>>,
    filter: Res<Shared<FilterTable>>,
    mut tiles: Query<(
        &Tile,
        &SampleNumber,
        &ActivePixels,
        &mut RasterPoints,
        &mut PixelSamples,
        Option<&mut SampleSigns>,
    )>,
) {
    for (tile, &SampleNumber(number), ActivePixels(active), mut raster, mut samples, mut signs) in &mut tiles {
        let rows = active.len();
        let (of_pixel, sample) = samples.slices_mut(rows);
        of_pixel.copy_from_slice(active);
        sample.fill(number);

        let (xs, ys) = raster.slices_mut(rows);
        match sampling.sampler {
            Sampler::Independent => {
                draw_points(Independent::new(number, 0, Purpose::Pixel), sampling.seed, tile, active, xs, ys);
            }
            Sampler::Stratified => {
                let draw = Stratified::new(number, sampling.samples, 0, Purpose::Pixel);
                draw_points(draw, sampling.seed, tile, active, xs, ys);
            }
            Sampler::Sobol => {
                draw_points(Sobol::new(number, 0, Purpose::Pixel), sampling.seed, tile, active, xs, ys);
            }
        }
        let signs = signs.as_mut().map(|signs| signs.slices_mut(rows));
        spread(&filter, tile, active, xs, ys, signs);
    }
}
// ANCHOR_END: place_samples

/// Draws a point of the unit square for each active pixel of a tile.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn draw_points<D: Draw>(draw: D, seed: u64, tile: &Tile, active: &[u32], xs: &mut [f64], ys: &mut [f64]) {
    for (&film_row, (across, down)) in active.iter().zip(xs.iter_mut().zip(ys)) {
        let [right, below] = draw.two(PixelKey::new(seed, tile.pixel_of(film_row as usize)));
        (*across, *down) = (unit(right), unit(below));
    }
}

/// Turns points of the unit square into raster points about their pixels' centres, spread as the filter weighs.
fn spread(
    filter: &FilterTable,
    tile: &Tile,
    active: &[u32],
    xs: &mut [f64],
    ys: &mut [f64],
    signs: Option<&mut [f32]>,
) {
    match filter.filter {
        Filter::Box { radius } => place(tile, active, xs, ys, |u| box_offset(u, radius)),
        Filter::Tent { radius } => place(tile, active, xs, ys, |u| tent_offset(u, radius)),
        Filter::Gaussian { .. } | Filter::Mitchell { .. } | Filter::BlackmanHarris { .. } => {
            if let Some(signs) = signs {
                for (sign, (x, y)) in signs.iter_mut().zip(xs.iter().zip(ys.iter())) {
                    let turned = table_offset(*x, &filter.cells).1 != table_offset(*y, &filter.cells).1;
                    *sign = if turned { -1.0 } else { 1.0 };
                }
            }
            place(tile, active, xs, ys, |u| table_offset(u, &filter.cells).0);
        }
    }
}

/// A raster point is its pixel's centre and an offset, added in f64: no bit of a 24-bit number is lost up to pixel 2²⁸.
#[inline(always)]
fn place(tile: &Tile, active: &[u32], xs: &mut [f64], ys: &mut [f64], offset: impl Fn(f64) -> f64) {
    for (&film_row, (across, down)) in active.iter().zip(xs.iter_mut().zip(ys)) {
        let [x, y] = tile.pixel_of(film_row as usize);
        *across = f64::from(x) + 0.5 + offset(*across);
        *down = f64::from(y) + 0.5 + offset(*down);
    }
}

/// The stage on offer: the alternative to raster points in the middle of their pixels.
pub fn place_samples_stage() -> Stage {
    Stage::new("Place samples", TileSystems::Raster, place_samples)
        .kind(StageKind::Alternative)
        .writes::<RasterPoints>()
        .writes::<PixelSamples>()
        .writes::<SampleSigns>()
        .table::<SamplingTable>()
        .table::<FilterTable>()
        .when(sampling_evidence)
}

/// Evidence that the camera takes several samples a pixel, or one at random.
pub fn sampling_evidence(scene: &World) -> Evidence {
    Evidence::of::<Sampling>(scene, "sampling camera")
}

/// Evidence that samples of the camera's filter count negatively in places.
pub fn signed_evidence(scene: &World) -> Evidence {
    let signed = |camera: EntityRef<'_>| camera.get::<Sampling>().is_some_and(|own| own.filter.is_signed());
    Evidence::among::<With<Sampling>>(scene, "camera whose filter is negative in places", signed)
}
