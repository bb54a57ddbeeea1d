//! Random numbers of rays.

use super::{Depth, Paths, PixelSamples, SampleNumber, Tile, pixel_of_row};
use crate::each::{Each, set_length};
use crate::extract::SamplingTable;
use crate::sample::{Draw, PixelKey, Purpose, SampleIndex, unit, with_sampler};
use bevy_ecs::query::QueryData;
use multiversion::multiversion;

/// Everything that determines a tile's random numbers at the current bounce.
pub struct Draws<'a> {
    /// The seed and the sampler.
    pub sampling: &'a SamplingTable,
    /// The tile's rectangle in the image.
    pub tile: &'a Tile,
    /// The index of the current sample of each pixel; `None` means 0.
    pub number: Option<&'a SampleNumber>,
    /// The pixels of the camera rays' rows; `None` if row and pixel coincide.
    pub samples: Option<&'a PixelSamples>,
    /// The paths of the rows; `None` if the scene has no bounces.
    pub paths: Option<&'a Paths>,
    /// The current depth.
    pub depth: Depth,
}

/// What a stage reads of a tile to draw random numbers for its rows.
#[derive(QueryData)]
pub struct DrawsView {
    /// The tile's rectangle in the image.
    pub tile: &'static Tile,
    /// The current depth; `None` means 0.
    pub depth: Option<&'static Depth>,
    /// The index of the current sample of each pixel; `None` means 0.
    pub number: Option<&'static SampleNumber>,
    /// The pixels of the camera rays' rows; `None` if row and pixel coincide.
    pub samples: Option<&'static PixelSamples>,
}

impl DrawsViewItem<'_, '_> {
    /// The numbers of these paths; `None` if the scene has no bounces.
    pub fn draws<'a>(&'a self, sampling: &'a SamplingTable, paths: Option<&'a Paths>) -> Draws<'a> {
        let depth = self.depth.copied().unwrap_or_default();
        Draws { sampling, tile: self.tile, number: self.number, samples: self.samples, paths, depth }
    }
}

impl Draws<'_> {
    /// The key of the pixel that a row's path belongs to.
    #[inline(always)]
    pub fn key(&self, row: usize) -> PixelKey {
        PixelKey::new(self.sampling.seed, pixel_of_row(self.tile, self.samples, self.paths, row))
    }

    /// The sample of each pixel that the numbers are for.
    pub fn sample(&self) -> SampleIndex {
        let number = self.number.map_or(0, |number| number.0);
        SampleIndex { number, samples: self.sampling.samples, depth: self.depth.0 }
    }
}

/// Draws a uniform point in [0, 1)² for each of these rows.
pub fn draws_of_two(of: &Draws<'_>, purpose: Purpose, rows: &[u32], into: &mut Vec<[f64; 2]>) {
    set_length(into, rows.len(), || [0.0; 2]);
    with_sampler!(of.sampling.sampler, D => {
        let draw = D::of(of.sample(), purpose);
        of.of_blocks(rows, into, |pixels, points| points_of_pixels(draw, of.sampling.seed, pixels, points));
    });
}

/// Draws a uniform number in [0, 1) for each of these rows.
pub fn draws_of_one(of: &Draws<'_>, purpose: Purpose, rows: &[u32], into: &mut Vec<f64>) {
    set_length(into, rows.len(), || 0.0);
    with_sampler!(of.sampling.sampler, D => {
        let draw = D::of(of.sample(), purpose);
        of.of_blocks(rows, into, |pixels, numbers| {
            let mut fractions = [0; AT_ONCE];
            fractions_of_pixels(draw, of.sampling.seed, pixels, &mut fractions[..numbers.len()]);
            numbers.iter_mut().zip(fractions).for_each(|(number, fraction)| *number = unit(fraction));
        });
    });
}

/// Draws a 32-bit fraction for each of these rows.
pub fn fractions_of_one(of: &Draws<'_>, purpose: Purpose, rows: &[u32], into: &mut Vec<u32>) {
    set_length(into, rows.len(), || 0);
    with_sampler!(of.sampling.sampler, D => {
        let draw = D::of(of.sample(), purpose);
        of.of_blocks(rows, into, |pixels, fractions| fractions_of_pixels(draw, of.sampling.seed, pixels, fractions));
    });
}

/// How many rows draw their numbers at once.
const AT_ONCE: usize = 64;

impl Draws<'_> {
    /// Calls a function with the pixels of each block of rows, x and y, and what is drawn for them.
    #[inline(always)]
    fn of_blocks<T>(&self, rows: &[u32], into: &mut [T], fill: impl Fn(&[[u32; AT_ONCE]; 2], &mut [T])) {
        for (rows, into) in rows.chunks(AT_ONCE).zip(into.chunks_mut(AT_ONCE)) {
            fill(&self.pixels(rows.iter().map(|&row| row as usize)), into);
        }
    }

    /// The pixels of at most so many rows, x and y.
    #[inline(always)]
    fn pixels(&self, rows: impl Iterator<Item = usize>) -> [[u32; AT_ONCE]; 2] {
        let mut pixels = [[0; AT_ONCE]; 2];
        for (lane, row) in rows.take(AT_ONCE).enumerate() {
            let [x, y] = pixel_of_row(self.tile, self.samples, self.paths, row);
            (pixels[0][lane], pixels[1][lane]) = (x, y);
        }
        pixels
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn points_of_pixels<D: Draw>(draw: D, seed: u64, [xs, ys]: &[[u32; AT_ONCE]; 2], into: &mut [[f64; 2]]) {
    for (point, (&x, &y)) in into.iter_mut().zip(xs.iter().zip(ys)) {
        *point = draw.two(PixelKey::new(seed, [x, y])).each(unit);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn fractions_of_pixels<D: Draw>(draw: D, seed: u64, [xs, ys]: &[[u32; AT_ONCE]; 2], into: &mut [u32]) {
    for (fraction, (&x, &y)) in into.iter_mut().zip(xs.iter().zip(ys)) {
        *fraction = draw.one(PixelKey::new(seed, [x, y]));
    }
}

// Random numbers for every row of a column, at depth 0.

/// Draws a uniform point in [0, 1)² for each row.
pub(super) fn draw_two(of: &Draws<'_>, purpose: Purpose, xs: &mut [f64], ys: &mut [f64]) {
    with_sampler!(of.sampling.sampler, D => {
        let (draw, mut points) = (D::of(of.sample(), purpose), [[0.0; 2]; AT_ONCE]);
        for (block, (xs, ys)) in xs.chunks_mut(AT_ONCE).zip(ys.chunks_mut(AT_ONCE)).enumerate() {
            let first = block * AT_ONCE;
            let points = &mut points[..xs.len()];
            points_of_pixels(draw, of.sampling.seed, &of.pixels(first..first + xs.len()), points);
            for (point, (x, y)) in points.iter().zip(xs.iter_mut().zip(ys)) {
                [*x, *y] = *point;
            }
        }
    });
}

/// Draws a uniform number in [0, 1) for each row.
pub(super) fn draw_one(of: &Draws<'_>, purpose: Purpose, xs: &mut [f64]) {
    with_sampler!(of.sampling.sampler, D => {
        let (draw, mut fractions) = (D::of(of.sample(), purpose), [0; AT_ONCE]);
        for (block, xs) in xs.chunks_mut(AT_ONCE).enumerate() {
            let first = block * AT_ONCE;
            let fractions = &mut fractions[..xs.len()];
            fractions_of_pixels(draw, of.sampling.seed, &of.pixels(first..first + xs.len()), fractions);
            fractions.iter().zip(xs).for_each(|(&fraction, x)| *x = unit(fraction));
        }
    });
}
