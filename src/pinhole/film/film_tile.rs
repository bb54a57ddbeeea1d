//! The film, tile by tile.

use super::develop::shown;
use super::{EarlierBlocks, FilmLayers, FilmMoments, FilmSplats};
use crate::each::Each;
use crate::plan::{Column, ColumnArrays, ColumnComponent, Lifetime, VectorRowsMut, column_component};
use crate::rays::Tile;
use rayon::prelude::*;
use std::ops::Range;

/// The number of steps in which a render takes the first sample: for every eighth, fourth, second, and finally every
/// pixel.
pub const FIRST_SAMPLE_STEPS: u32 = 4;

/// A sample that was not added to the film, because a component was negative or not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rejected {
    /// The pixel, from the left and from the top of the image.
    pub pixel: [u32; 2],
    /// The sample's index within the pixel.
    pub sample: u32,
    /// The offending radiance.
    pub radiance: [f32; 3],
}

impl Rejected {
    /// How many of them a tile keeps; all are counted.
    pub const MAX: usize = 4;

    /// The order in which they are reported: by sample, then line by line from the top.
    pub(super) fn place(&self) -> [u32; 3] {
        [self.sample, self.pixel[1], self.pixel[0]]
    }
}

/// The film of one tile: sums in f64 and counts of samples, with a row per pixel.
///
/// All samples are summed; those of negative filter weight are also summed separately, so that both the weighted and
/// the unweighted mean can be computed; a tile without any allocates nothing for them.
/// Samples are added in order and in blocks (see [`BLOCK`](super::BLOCK)), so neither the number of threads nor the tile
/// size nor the machines that share the work change a bit of the sums.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilmTile {
    /// The pixels that it covers.
    pub tile: Tile,
    /// Sums of red, green and blue radiance, over the block of samples in progress.
    pub sum: [Vec<f64>; 3],
    /// Number of samples summed, in all blocks.
    pub count: Vec<u32>,
    /// Sums of the red, green and blue radiance of samples on a negative lobe of the filter; empty before the first.
    pub negative: [Vec<f64>; 3],
    /// Number of samples on a negative lobe; empty before the first.
    pub negative_count: Vec<u32>,
    /// Number of samples rejected.
    pub rejected: u64,
    /// The first of the rejected samples.
    pub first_rejected: Vec<Rejected>,
    /// The sums over earlier blocks of samples; none before the second block.
    pub earlier: Option<Box<EarlierBlocks>>,
    /// The minimum of a component of a sample: 0, or, where paths have wavelengths, whose weights may be negative, that of
    /// all numbers.
    pub min: f32,
}

impl FilmTile {
    /// An empty film of a tile.
    pub fn new(tile: Tile) -> Self {
        let rows = tile.rows();
        Self { tile, sum: [(); 3].each(|()| vec![0.0; rows]), count: vec![0; rows], ..Self::default() }
    }

    /// Takes all samples away, and keeps the memory.
    pub(super) fn empty(&mut self) {
        self.sum.set_all([0.0; 3]);
        self.count.fill(0);
        self.negative.iter_mut().for_each(Vec::clear);
        self.negative_count.clear();
        self.rejected = 0;
        self.first_rejected.clear();
        self.earlier = None;
    }

    /// Whether a sample is valid: all components are finite, and not negative unless they may be.
    #[inline(always)]
    pub fn accepts(&self, radiance: [f32; 3]) -> bool {
        let [r, g, b] = radiance.each(|value| (value >= self.min) & (value < f32::INFINITY));
        r & g & b
    }

    /// Adds a sample to a row, or rejects it if a component is negative or not finite.
    #[inline(always)]
    pub fn add(&mut self, row: usize, radiance: [f32; 3]) {
        if self.accepts(radiance) {
            self.sum.add(row, radiance.each(f64::from));
            self.count[row] += 1;
        } else {
            self.reject(row, radiance);
        }
    }

    /// Adds a sample to each row, component by component; there may be fewer samples than rows.
    pub fn add_rows(&mut self, radiance: [&[f32]; 3]) {
        let [r, g, b] = radiance;
        let samples = r.iter().zip(g).zip(b).map(|((&r, &g), &b)| [r, g, b]);
        if samples.clone().fold(true, |all, sample| all & self.accepts(sample)) {
            for (sums, parts) in self.sum.iter_mut().zip(radiance) {
                sums.iter_mut().zip(parts).for_each(|(sum, &part)| *sum += f64::from(part));
            }
            self.count.iter_mut().zip(r).for_each(|(count, _)| *count += 1);
        } else {
            (0..self.rows()).zip(samples).for_each(|(row, sample)| self.add(row, sample));
        }
    }

    /// Keeps those that come first by sample and then by pixel, whatever the order in which they are traced.
    #[cold]
    fn reject(&mut self, row: usize, radiance: [f32; 3]) {
        self.rejected += 1;
        self.remember(Rejected { pixel: self.tile.pixel_of(row), sample: self.count[row], radiance });
    }

    /// Remembers a rejected sample, if it is among the first.
    pub(super) fn remember(&mut self, rejected: Rejected) {
        let at = self.first_rejected.partition_point(|earlier| earlier.place() <= rejected.place());
        self.first_rejected.insert(at, rejected);
        self.first_rejected.truncate(Rejected::MAX);
    }

    /// Adds a sample of negative filter weight, or rejects it.
    #[inline(never)]
    pub fn add_negative(&mut self, row: usize, radiance: [f32; 3]) {
        self.add(row, radiance);
        if self.accepts(radiance) {
            let rows = self.rows();
            self.negative_count.resize(rows, 0);
            self.negative_count[row] += 1;
            for (sums, value) in self.negative.iter_mut().zip(radiance) {
                sums.resize(rows, 0.0);
                sums[row] += f64::from(value);
            }
        }
    }

    /// The radiance of a row as a picture shows it: the mean of its samples, weighted by the filter; black if there are
    /// none.
    ///
    /// If the sum of weights is not positive, which may happen after a few samples of a filter with negative lobes, it
    /// is the unweighted mean.
    /// Negative values, where such a filter rings, become 0.
    pub fn mean(&self, row: usize) -> [f32; 3] {
        self.shown_f64(row).each(shown)
    }

    /// The same, unrounded, and negative where a filter rings.
    #[inline(always)]
    pub fn shown_f64(&self, row: usize) -> [f64; 3] {
        self.weighted(row).unwrap_or_else(|| self.mean_f64(row))
    }

    /// The sum of a row's filter weights, which are 1 or −1.
    pub fn weight(&self, row: usize) -> i64 {
        let negative = self.negative_count.get(row).copied().unwrap_or(0);
        i64::from(self.count[row]) - 2 * i64::from(negative)
    }

    /// The weighted mean of a row, which may be negative; `None` if the sum of weights is not positive.
    pub fn weighted(&self, row: usize) -> Option<[f64; 3]> {
        let weight = self.weight(row);
        if weight <= 0 {
            return None;
        }
        Some(self.weighted_sums(row).each(|sum| sum / weight as f64))
    }

    /// The weighted sums of a row.
    pub fn weighted_sums(&self, row: usize) -> [f64; 3] {
        let sums = self.sums(row);
        [0, 1, 2].each(|channel| sums[channel] - 2.0 * self.negative_sum(channel, row))
    }

    /// The unweighted mean of a row's samples, unrounded.
    #[inline(always)]
    pub fn mean_f64(&self, row: usize) -> [f64; 3] {
        let count = f64::from(self.count[row].max(1));
        self.sums(row).each(|sum| sum / count)
    }
}

column_component!(FilmTile);

impl Column for FilmTile {
    const NAME: &'static str = "pixel";
    const SPACE: &'static str = "film";
    const UNIT: &'static str = "summed linear Rec. 709";
    const LIFETIME: Lifetime = Lifetime::Film;

    fn rows(&self) -> usize {
        self.count.len()
    }

    fn components(&self) -> Vec<ColumnComponent<'_>> {
        let mut components = Vec::new();
        self.sum.list(&["r", "g", "b"], &mut components);
        self.count.list(&["count"], &mut components);
        if !self.negative_count.is_empty() {
            self.negative.list(&["negative_r", "negative_g", "negative_b"], &mut components);
            self.negative_count.list(&["negative_count"], &mut components);
        }
        if let Some(earlier) = &self.earlier {
            earlier.sum.list(&["earlier_r", "earlier_g", "earlier_b"], &mut components);
        }
        components
    }

    fn paint(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.mean(row)
    }
}

/// The whole film, divided into tiles so that each can be lent to a worker.
///
/// All of it is saved in a checkpoint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Film {
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom.
    pub height: u32,
    /// The pixel of the image that the first one of the film is: (0, 0), unless only a part of the image is rendered.
    pub origin: [u32; 2],
    /// The side of a full tile, in pixels.
    pub tile_side: u32,
    /// The tiles, from left to right, then downward.
    pub tiles: Vec<FilmTile>,
    /// The second moments of each tile; empty if nothing needs them.
    pub moments: Vec<FilmMoments>,
    /// The layers of each tile; empty if none are requested.
    pub layers: Vec<FilmLayers>,
    /// The splats of light tracing; `None` if there is no light tracing.
    pub splats: Option<FilmSplats>,
    /// How many steps of the render each tile has completed.
    pub done: Vec<u32>,
    /// Whether this is the pilot pass of adaptive sampling, whose samples only decide how many each pixel gets.
    pub pilot: bool,
    /// The number of samples that adaptive sampling allots to each pixel, tile by tile; empty before that is decided.
    pub planned: Vec<Vec<u32>>,
}

impl Film {
    /// An empty film, divided into tiles.
    pub fn new(width: u32, height: u32, tile_side: u32) -> Self {
        Self::of_part(Tile { x: 0, y: 0, width, height }, tile_side)
    }

    /// An empty film of a part of an image, divided into tiles, which know their places in the image.
    pub fn of_part(part: Tile, tile_side: u32) -> Self {
        let (Tile { width, height, .. }, mut tiles) = (part, Vec::new());
        for y in (0..height).step_by(tile_side as usize) {
            for x in (0..width).step_by(tile_side as usize) {
                let (width, height) = (tile_side.min(width - x), tile_side.min(height - y));
                tiles.push(FilmTile::new(Tile { x: part.x + x, y: part.y + y, width, height }));
            }
        }
        let origin = [part.x, part.y];
        Self { width, height, origin, tile_side, done: vec![0; tiles.len()], tiles, ..Self::default() }
    }

    /// The part of the image that it is a film of.
    pub fn part(&self) -> Tile {
        let [x, y] = self.origin;
        Tile { x, y, width: self.width, height: self.height }
    }

    /// Takes all samples away, and keeps the memory, for the next of many frames.
    pub fn empty(&mut self) {
        self.tiles.par_iter_mut().for_each(FilmTile::empty);
        self.moments.par_iter_mut().for_each(FilmMoments::empty);
        self.layers.par_iter_mut().for_each(FilmLayers::empty);
        if let Some(splats) = &mut self.splats {
            *splats = splats.emptied();
        }
        self.done.fill(0);
        self.planned.clear();
        self.pilot = false;
    }

    /// A film of the same size and contents without samples.
    pub fn emptied(&self) -> Self {
        let mut film = Self::of_part(self.part(), self.tile_side);
        film.tiles.iter_mut().zip(&self.tiles).for_each(|(tile, own)| tile.min = own.min);
        let rows = |tile: &FilmTile| tile.tile.rows();
        if !self.moments.is_empty() {
            film.moments = film.tiles.iter().map(|tile| FilmMoments::new(rows(tile))).collect();
        }
        film.splats = self.splats.as_ref().map(FilmSplats::emptied);
        if let Some(layers) = self.layers.first() {
            film.layers = film.tiles.iter().map(|tile| FilmLayers::new(rows(tile), &layers.kinds)).collect();
        }
        film
    }

    /// The mean radiance of a pixel of the film, linear Rec. 709.
    ///
    /// While the first samples are being taken, a pixel without a sample shows the nearest one up and to the left that
    /// has one.
    pub fn mean(&self, x: u32, y: u32) -> [f32; 3] {
        let (tile, row) = self.place(x, y);
        self.mean_in(tile, row, [x, y])
    }

    /// The same of all pixels, line by line.
    pub fn means(&self) -> Vec<[f32; 3]> {
        let mut means = vec![[0.0; 3]; self.width as usize * self.height as usize];
        let (bands, pixels) = self.bands();
        means.par_chunks_mut(pixels).zip(bands).for_each(|(means, tiles)| {
            tiles.for_each(|tile| self.for_each_mean(tile, |at, mean| means[at] = mean));
        });
        means
    }

    /// The mean of a pixel that is this row of this tile.
    #[inline]
    pub(super) fn mean_in(&self, tile: usize, row: usize, [x, y]: [u32; 2]) -> [f32; 3] {
        let waiting =
            self.tiles[tile].count[row] == 0 && self.done.get(tile).is_some_and(|&done| done < FIRST_SAMPLE_STEPS);
        if !waiting {
            return self.with_splats(x, y, &self.tiles[tile], row).each(shown);
        }
        let coarser = [2, 4, 8].each(|side| {
            let [left, top] = self.origin;
            let (x, y) = ((x + left) / side * side, (y + top) / side * side);
            Some(self.place(x.checked_sub(left)?, y.checked_sub(top)?))
        });
        let traced = |&(tile, row): &(usize, usize)| self.tiles[tile].count[row] > 0;
        let (tile, row) = coarser.into_iter().flatten().find(traced).unwrap_or((tile, row));
        self.with_splats(x, y, &self.tiles[tile], row).each(shown)
    }

    /// Hands the mean of each pixel of a tile to `each`, with its place in the band of the film that the tile is in: the
    /// lines from the tile's first to its last.
    #[inline(always)]
    pub(super) fn for_each_mean(&self, tile: usize, mut each: impl FnMut(usize, [f32; 3])) {
        let own = &self.tiles[tile];
        let Tile { width, height, .. } = own.tile;
        let [x, y] = self.corner(tile);
        let waits = || self.done.get(tile).is_some_and(|&done| done < FIRST_SAMPLE_STEPS) && own.count.contains(&0);
        // A mean is then no more than a sum over a count of samples.
        let is_plain = self.splats.is_none() && own.negative_count.is_empty() && own.earlier.is_none() && !waits();
        for line in 0..height {
            let start = (line * self.width + x) as usize;
            let rows = (line * width) as usize..((line + 1) * width) as usize;
            if is_plain {
                let [red, green, blue] = [0, 1, 2].each(|channel| &own.sum[channel][rows.clone()]);
                let parts = red.iter().zip(green).zip(blue).zip(&own.count[rows]);
                for (at, (((&red, &green), &blue), &count)) in parts.enumerate() {
                    let sums = [red, green, blue];
                    let means = if count > 1 { sums.each(|sum| sum / f64::from(count)) } else { sums };
                    each(start + at, means.each(shown));
                }
            } else {
                for (at, row) in rows.enumerate() {
                    each(start + at, self.mean_in(tile, row, [x + at as u32, y + line]));
                }
            }
        }
    }

    /// The numbers of the tiles in each band of lines, from the top, and how many pixels a full band has.
    pub(super) fn bands(&self) -> (impl IndexedParallelIterator<Item = Range<usize>>, usize) {
        let side = self.tile_side.max(1);
        let across = self.width.div_ceil(side) as usize;
        let bands = (0..self.height.div_ceil(side) as usize).into_par_iter();
        let pixels = (self.width as usize * side as usize).max(1);
        (bands.map(move |band| band * across..(band + 1) * across), pixels)
    }

    /// The mean of a tile's row plus the splats of a pixel.
    fn with_splats(&self, x: u32, y: u32, tile: &FilmTile, row: usize) -> [f64; 3] {
        let (camera, splats) = (tile.shown_f64(row), self.splats.as_ref().map(|splats| splats.mean(x, y)));
        splats.map_or(camera, |splats| [0, 1, 2].each(|channel| camera[channel] + splats[channel]))
    }

    /// The number of pixels whose radiance exceeds the range of f32, and which are shown with its largest value.
    pub fn too_bright(&self) -> usize {
        let pixels = (0..self.height).flat_map(|y| (0..self.width).map(move |x| (x, y)));
        let is_too_bright = |&(x, y): &(u32, u32)| {
            let (tile, row) = self.place(x, y);
            self.with_splats(x, y, &self.tiles[tile], row).iter().any(|&value| value > f64::from(f32::MAX))
        };
        pixels.filter(is_too_bright).count()
    }

    /// The index of the tile that contains a pixel of the film, and the pixel's row in it.
    pub fn place(&self, x: u32, y: u32) -> (usize, usize) {
        let across = self.width.div_ceil(self.tile_side);
        let number = (y / self.tile_side * across + x / self.tile_side) as usize;
        let (tile, [left, top]) = (&self.tiles[number].tile, self.corner(number));
        (number, ((y - top) * tile.width + (x - left)) as usize)
    }

    /// The pixel of the film that a tile begins with.
    #[inline(always)]
    pub(super) fn corner(&self, tile: usize) -> [u32; 2] {
        let Tile { x, y, .. } = self.tiles[tile].tile;
        [x - self.origin[0], y - self.origin[1]]
    }

    /// The estimated variance of a pixel's mean: red, green, blue; 0 with fewer than two samples.
    ///
    /// If some of n samples have negative weights, with a sum W of all weights, it is the variance of a ratio estimator
    /// to first order: (n V + n (M − R)²) / W² with the variance V of a sample, the unweighted mean M and the weighted
    /// mean R; [`FilmMoments::variance`] is n² V / W² already.
    pub fn variance_of_mean(&self, tile: usize, row: usize) -> [f64; 3] {
        let film = &self.tiles[tile];
        let (count, weight) = (film.count[row], film.weight(row));
        let variance = self.moments.get(tile).map_or([0.0; 3], |own| own.variance(&self.tiles[tile], row));
        let n = f64::from(count.max(1));
        match film.weighted(row) {
            Some(weighted) if weight < i64::from(count) => {
                let mean = film.mean_f64(row);
                let difference = [0, 1, 2].each(|channel| mean[channel] - weighted[channel]);
                let factor = n / (weight as f64 * weight as f64);
                [0, 1, 2].each(|channel| variance[channel] / n + difference[channel] * difference[channel] * factor)
            }
            _ => variance.each(|value| value / n),
        }
    }

    /// The artifacts of a filter with negative lobes: the number of pixels whose sum of weights is not positive
    /// although they have samples, and the number of pixels with a negative component.
    pub fn filter_artifacts(&self) -> (usize, usize) {
        let signed = self.tiles.iter().filter(|tile| !tile.negative_count.is_empty());
        let (mut without, mut below) = (0, 0);
        for tile in signed {
            for row in 0..tile.rows() {
                let weighted = tile.weighted(row);
                without += usize::from(weighted.is_none() && tile.count[row] > 0);
                below += usize::from(weighted.is_some_and(|mean| mean.iter().any(|&value| value < 0.0)));
            }
        }
        (without, below)
    }

    /// All rejected samples: their number, and the first few.
    pub fn rejected(&self) -> (u64, Vec<Rejected>) {
        let of_lights = self.splats.as_ref().map_or(0, |splats| splats.rejected);
        let count = self.tiles.iter().map(|tile| tile.rejected).sum::<u64>() + of_lights;
        let mut first: Vec<Rejected> = self.tiles.iter().flat_map(|tile| tile.first_rejected.clone()).collect();
        first.sort_by_key(Rejected::place);
        first.truncate(Rejected::MAX);
        (count, first)
    }

    /// The memory of its sums, counts, moments, layers and splats, in bytes.
    pub fn bytes(&self) -> usize {
        let a_row = 3 * size_of::<f64>() + size_of::<u32>();
        let rows = |tile: &FilmTile| tile.count.len() + tile.negative_count.len();
        let of_tile = |tile: &FilmTile| rows(tile) * a_row + tile.earlier_bytes() + size_of::<FilmTile>();
        let sums: usize = self.tiles.iter().map(of_tile).sum();
        let of_moments = |own: &FilmMoments| (own.rows() + own.earlier[0].len()) * 3 * size_of::<f64>();
        let moments = self.moments.iter().map(|own| of_moments(own) + size_of::<FilmMoments>());
        let planned = self.planned.iter().map(|own| own.len() * size_of::<u32>());
        let splats = self.splats.as_ref().map_or(0, FilmSplats::bytes);
        splats + sums + moments.chain(planned).chain(self.layers.iter().map(FilmLayers::bytes)).sum::<usize>()
    }
}
