use super::{RasterPoints, Tile};
use crate::each::set_all;
use crate::extract::{FilterTable, SamplingTable};
use crate::filters::{FilterCells, Kernel, table_offset, with_filter};
use crate::plan::{Census, Evidence, Shared, Stage, StageKind, TileSystems, column};
use crate::sample::{Draw, PixelKey, Purpose, SampleIndex, unit, with_sampler};
use crate::scene::Sampling;
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use multiversion::multiversion;

column! {
    /// Which sample of which pixel each row is; exists if the camera has a [`Sampling`].
    pub struct PixelSamples("samples", "film", "rows and counts", Pixel) {
        /// The row of the tile's film.
        pixel: u32,
        /// The sample's index within its pixel.
        sample: u32,
    }
}

impl PixelSamples {
    /// Paints the sample's index as grey.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.sample[row] as f32 / (1.0 + self.sample[row] as f32); 3]
    }
}

column! {
    /// The sign of each sample's filter weight; exists if the filter has negative lobes.
    pub struct SampleSigns("sign", "film", "1 or −1", Pixel) {
        /// 1, or −1 on a negative lobe.
        sign: f32,
    }
}

impl SampleSigns {
    /// Paints 1 white and −1 red.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        if self.sign[row] < 0.0 { [1.0, 0.0, 0.0] } else { [1.0; 3] }
    }
}

/// On a tile's entity: the index of the sample that each pixel takes next.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SampleNumber(pub u32);

/// On a tile's entity: the rows of its film that take the next sample, in ascending order.
#[derive(Component, Clone, Debug, Default, PartialEq, Eq)]
pub struct ActivePixels(pub Vec<u32>);

/// The pixels of a tile that take part, and where their samples are placed.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct PlacementView {
    tile: &'static Tile,
    number: &'static SampleNumber,
    active: &'static ActivePixels,
    raster: &'static mut RasterPoints,
    samples: &'static mut PixelSamples,
    signs: Option<&'static mut SampleSigns>,
}

// ANCHOR: place_samples
/// Fills a tile's raster points with one sample of each of its active pixels.
pub fn place_samples(
    sampling: Res<Shared<SamplingTable>>,
    filter: Res<Shared<FilterTable>>,
    mut tiles: Query<PlacementView>,
) {
    for PlacementViewItem {
        tile,
        number: &SampleNumber(number),
        active: ActivePixels(active),
        mut raster,
        mut samples,
        mut signs,
    } in &mut tiles
    {
        let [xs, ys] = raster.slices_mut(active.len());
        let (of_pixel, sample) = samples.slices_mut(active.len());
        of_pixel.copy_from_slice(active);
        set_all(sample, number);

        let to = (active.as_slice(), tile, sampling.seed);
        let sample = SampleIndex { number, samples: sampling.samples, depth: 0 };
        with_sampler!(sampling.sampler, D => draw_points(D::of(sample, Purpose::Pixel), to, xs, ys));
        if let Some(signs) = &mut signs {
            fill_signs(&filter.cells, xs, ys, signs.slices_mut(active.len()));
        }
        let cells = &filter.cells;
        with_filter!(filter.filter, kernel => spread((kernel, cells), active, tile, xs, ys));
    }
}
// ANCHOR_END: place_samples

/// Draws a uniform point in [0, 1)² for each active pixel of a tile.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn draw_points<D: Draw>(draw: D, (active, tile, seed): (&[u32], &Tile, u64), xs: &mut [f64], ys: &mut [f64]) {
    for (run, [first, line]) in tile.runs_of(active) {
        let (xs, ys) = (&mut xs[run.clone()], &mut ys[run]);
        for at in 0..xs.len().min(ys.len()) {
            let [right, down] = draw.two(PixelKey::new(seed, [first + at as u32, line]));
            (xs[at], ys[at]) = (unit(right), unit(down));
        }
    }
}

/// The sign of the filter at these points of the unit square: the product of its signs in x and in y.
fn fill_signs(cells: &FilterCells, xs: &[f64], ys: &[f64], signs: &mut [f32]) {
    for (sign, (&x, &y)) in signs.iter_mut().zip(xs.iter().zip(ys)) {
        *sign = if table_offset(x, cells).1 == table_offset(y, cells).1 { 1.0 } else { -1.0 };
    }
}

/// Maps points of the unit square to raster points about the centres of their pixels, distributed as the filter.
///
/// The sum is taken in f64, where no bit of a 24-bit fraction is lost beside a pixel index below 2²⁸.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn spread<K: Kernel>((kernel, cells): (K, &FilterCells), active: &[u32], tile: &Tile, xs: &mut [f64], ys: &mut [f64]) {
    for (run, [first, line]) in tile.runs_of(active) {
        let (xs, ys) = (&mut xs[run.clone()], &mut ys[run]);
        for at in 0..xs.len().min(ys.len()) {
            xs[at] = f64::from(first + at as u32) + 0.5 + kernel.offset(xs[at], cells).0;
            ys[at] = f64::from(line) + 0.5 + kernel.offset(ys[at], cells).0;
        }
    }
}

/// The stage that places samples, the alternative to raster points at the centres of pixels.
pub fn place_samples_stage() -> Stage {
    Stage::new("Place samples", TileSystems::Raster, place_samples).kind(StageKind::Alternative).when(sampling_evidence)
}

/// Evidence that the camera places its samples at random.
pub fn sampling_evidence(scene: &Census<'_>) -> Evidence {
    Evidence::of::<Sampling>(scene, "sampling camera")
}

/// Evidence that the camera's filter has negative lobes.
pub fn signed_evidence(scene: &Census<'_>) -> Evidence {
    let signed = |camera: EntityRef<'_>| camera.get::<Sampling>().is_some_and(|own| own.filter.is_signed());
    Evidence::among::<With<Sampling>>(scene, "camera whose filter is negative in places", signed)
}
