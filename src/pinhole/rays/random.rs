//! Random numbers for each row of a tile; the sampler is dispatched once per tile.

use super::{PixelSamples, SampleNumber, Tile};
use crate::extract::SamplingTable;
use crate::sample::{Draw, PixelKey, Purpose, SampleIndex, unit, with_sampler};
use multiversion::multiversion;

/// Which sample of which pixel each row of a tile is, with the seed and the sampler.
#[derive(Clone, Copy)]
pub(super) struct Rows<'a> {
    pub sampling: &'a SamplingTable,
    pub tile: &'a Tile,
    pub number: Option<&'a SampleNumber>,
    pub samples: Option<&'a PixelSamples>,
}

impl Rows<'_> {
    fn sample(&self) -> SampleIndex {
        let number = self.number.map_or(0, |number| number.0);
        SampleIndex { number, samples: self.sampling.samples, depth: 0 }
    }
}

/// Draws a uniform point in [0, 1)² for each row, at depth 0.
pub(super) fn draw_two(rows: Rows<'_>, purpose: Purpose, xs: &mut [f64], ys: &mut [f64]) {
    with_sampler!(rows.sampling.sampler, D => two_rows(D::of(rows.sample(), purpose), rows, xs, ys));
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn two_rows<D: Draw>(draw: D, rows: Rows<'_>, xs: &mut [f64], ys: &mut [f64]) {
    for (row, (x, y)) in xs.iter_mut().zip(ys).enumerate() {
        let [a, b] = draw.two(key(rows, row));
        (*x, *y) = (unit(a), unit(b));
    }
}

/// The key of a row's pixel, which is that of its own index in the tile unless samples are placed.
#[inline(always)]
fn key(rows: Rows<'_>, row: usize) -> PixelKey {
    let pixel = rows.samples.map_or(row, |samples| samples.pixel[row] as usize);
    PixelKey::new(rows.sampling.seed, rows.tile.pixel_of(pixel))
}

/// Draws a uniform number in [0, 1) for each row, at depth 0.
pub(super) fn draw_one(rows: Rows<'_>, purpose: Purpose, xs: &mut [f64]) {
    with_sampler!(rows.sampling.sampler, D => one_rows(D::of(rows.sample(), purpose), rows, xs));
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn one_rows<D: Draw>(draw: D, rows: Rows<'_>, xs: &mut [f64]) {
    for (row, x) in xs.iter_mut().enumerate() {
        *x = unit(draw.one(key(rows, row)));
    }
}
