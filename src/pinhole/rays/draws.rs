//! Random numbers of rays.

use super::{Depth, Paths, PixelSamples, SampleNumber, Tile, pixel_of_row};
use crate::each::{Each, gathered, lanes_of, set_length};
use crate::extract::SamplingTable;
use crate::sample::{Draw, NO_PLACES, PixelKey, Purpose, SampleIndex, unit, with_sampler};
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
        SampleIndex { number, samples: self.sampling.samples, depth: self.sampling.bounce(self.depth.0) }
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
            fill(&self.pixels(&lanes_of(rows, 0_u32)), into);
        }
    }

    /// The pixels of so many rows, x and y.
    #[inline(always)]
    fn pixels(&self, rows: &[u32; AT_ONCE]) -> [[u32; AT_ONCE]; 2] {
        pixels_of_rows(self.tile, self.samples, self.paths, rows)
    }

    /// Those of as many rows from one on.
    #[inline(always)]
    fn pixels_from(&self, first: usize) -> [[u32; AT_ONCE]; 2] {
        let mut rows = [0; AT_ONCE];
        for (row, number) in rows.iter_mut().zip(first as u32..) {
            *row = number;
        }
        self.pixels(&rows)
    }
}

/// [`pixel_of_row`] of many rows; of those that are not there, some pixels.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn pixels_of_rows(
    tile: &Tile,
    samples: Option<&PixelSamples>,
    paths: Option<&Paths>,
    rows: &[u32; AT_ONCE],
) -> [[u32; AT_ONCE]; 2] {
    let mut of = *rows;
    if let Some(paths) = paths {
        of = gathered(&paths.first, &of);
    }
    if let Some(samples) = samples {
        of = gathered(&samples.pixel, &of);
    }
    // No processor divides several integers at once. Of (row + ½) / width the part before the point is what f64 rounds it to
    // less ½, since it is further from an integer than all rounding leads; the number beside which there are no places
    // does the rounding.
    let of_one = 1.0 / f64::from(tile.width);
    let before = 0.5 * of_one - 0.5;
    let mut pixels = [[0; AT_ONCE]; 2];
    for lane in 0..AT_ONCE {
        let line = (f64::from(of[lane]) * of_one + before + NO_PLACES).to_bits() as u32;
        pixels[0][lane] = tile.x.wrapping_add(of[lane].wrapping_sub(line.wrapping_mul(tile.width)));
        pixels[1][lane] = tile.y.wrapping_add(line);
    }
    pixels
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn points_of_pixels<D: Draw>(draw: D, seed: u64, [xs, ys]: &[[u32; AT_ONCE]; 2], into: &mut [[f64; 2]]) {
    for lane in 0..into.len().min(AT_ONCE) {
        into[lane] = draw.two(PixelKey::new(seed, [xs[lane], ys[lane]])).each(unit);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn fractions_of_pixels<D: Draw>(draw: D, seed: u64, [xs, ys]: &[[u32; AT_ONCE]; 2], into: &mut [u32]) {
    for lane in 0..into.len().min(AT_ONCE) {
        into[lane] = draw.one(PixelKey::new(seed, [xs[lane], ys[lane]]));
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
            points_of_pixels(draw, of.sampling.seed, &of.pixels_from(first), points);
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
            fractions_of_pixels(draw, of.sampling.seed, &of.pixels_from(first), fractions);
            fractions.iter().zip(xs).for_each(|(&fraction, x)| *x = unit(fraction));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of whole tiles and of their last rows, of every width up to 70 and of some as wide as an image may be, with and
    /// without samples and paths.
    #[test]
    fn the_pixels_of_many_rows_are_those_of_each() {
        let mut tried = 0;
        for width in (1..=70).chain([1024, 1 << 20, (1 << 20) - 1, 65_537]) {
            let tile = Tile { x: 5, y: 1 << 20, width, height: 2000 };
            let last = tile.rows() as u32 - 1;
            let firsts = [0, width - 1, width, 17 * width - 1, last / 2, last - 64 * (last / 65), last];
            let mixed: Vec<u32> = (0..500).map(|row: u32| row.wrapping_mul(7919) % (last + 1)).collect();
            let (samples, paths) = (
                PixelSamples { pixel: mixed.clone(), ..Default::default() },
                Paths { first: mixed.clone(), ..Default::default() },
            );
            let first = (0..500).map(|row: u32| row * 7 % 500).collect();
            let of_samples = Paths { first, ..Default::default() };
            let all: [(Option<&PixelSamples>, Option<&Paths>, u32); 4] = [
                (None, None, last),
                (Some(&samples), None, 499),
                (None, Some(&paths), 499),
                (Some(&samples), Some(&of_samples), 499),
            ];
            for (samples, paths, end) in all {
                for first in firsts {
                    let rows: [u32; AT_ONCE] = std::array::from_fn(|lane| (first + lane as u32 * 3).min(end));
                    let [x, y] = pixels_of_rows(&tile, samples, paths, &rows);
                    for (lane, &row) in rows.iter().enumerate() {
                        assert_eq!(
                            [x[lane], y[lane]],
                            pixel_of_row(&tile, samples, paths, row as usize),
                            "{width}, {row}"
                        );
                        tried += 1;
                    }
                }
            }
        }
        eprintln!("pixels of {tried} rows");
    }
}
