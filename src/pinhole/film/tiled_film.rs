use super::develop::shown;
use super::film_tile::{FIRST_SAMPLE_STEPS, FilmTile, Rejected};
use super::{FilmLayers, FilmMoments, FilmSplats};
use crate::plan::Column;
use crate::rays::Tile;
use rayon::prelude::*;
use std::ops::Range;

/// The whole film, divided into tiles so that each can be lent to a worker.
///
/// All of it is saved in a checkpoint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Film {
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom.
    pub height: u32,
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
        let mut tiles = Vec::new();
        for y in (0..height).step_by(tile_side as usize) {
            for x in (0..width).step_by(tile_side as usize) {
                let (width, height) = (tile_side.min(width - x), tile_side.min(height - y));
                tiles.push(FilmTile::new(Tile { x, y, width, height }));
            }
        }
        Self { width, height, tile_side, done: vec![0; tiles.len()], tiles, ..Self::default() }
    }

    /// Takes all samples away, and keeps the memory, for the next of many frames.
    pub fn empty(&mut self) {
        self.tiles.par_iter_mut().for_each(FilmTile::empty);
        self.moments.par_iter_mut().for_each(FilmMoments::empty);
        self.layers.par_iter_mut().for_each(FilmLayers::empty);
        if let Some(splats) = &mut self.splats {
            *splats = FilmSplats::new(self.width, self.height);
        }
        self.done.fill(0);
        self.planned.clear();
        self.pilot = false;
    }

    /// A film of the same size and contents without samples.
    pub fn emptied(&self) -> Self {
        let mut film = Self::new(self.width, self.height, self.tile_side);
        let rows = |tile: &FilmTile| tile.tile.rows();
        if !self.moments.is_empty() {
            film.moments = film.tiles.iter().map(|tile| FilmMoments::new(rows(tile))).collect();
        }
        film.splats = self.splats.as_ref().map(|_| FilmSplats::new(self.width, self.height));
        if let Some(layers) = self.layers.first() {
            film.layers = film.tiles.iter().map(|tile| FilmLayers::new(rows(tile), &layers.kinds)).collect();
        }
        film
    }

    /// The mean radiance of a pixel, linear Rec. 709.
    ///
    /// While the first samples are being taken, a pixel without a sample shows the nearest one up and to the left that
    /// has one.
    pub fn mean(&self, x: u32, y: u32) -> [f32; 3] {
        let (tile, row) = self.place(x, y);
        self.mean_in(tile, row, [x, y])
    }

    /// The mean of a pixel that is this row of this tile.
    #[inline]
    pub(super) fn mean_in(&self, tile: usize, row: usize, [x, y]: [u32; 2]) -> [f32; 3] {
        let waiting =
            self.tiles[tile].count[row] == 0 && self.done.get(tile).is_some_and(|&done| done < FIRST_SAMPLE_STEPS);
        if !waiting {
            return self.with_splats(x, y, &self.tiles[tile], row).map(shown);
        }
        let coarser = [2, 4, 8].map(|side| self.place(x / side * side, y / side * side));
        let traced = |&(tile, row): &(usize, usize)| self.tiles[tile].count[row] > 0;
        let (tile, row) = coarser.into_iter().find(traced).unwrap_or((tile, row));
        self.with_splats(x, y, &self.tiles[tile], row).map(shown)
    }

    /// Hands the mean of each pixel of a tile to `each`, with its place in the band of the film that the tile is in: the
    /// lines from the tile's first to its last.
    #[inline(always)]
    pub(super) fn for_each_mean(&self, tile: usize, mut each: impl FnMut(usize, [f32; 3])) {
        let own = &self.tiles[tile];
        let Tile { x, y, width, height } = own.tile;
        let waits = || self.done.get(tile).is_some_and(|&done| done < FIRST_SAMPLE_STEPS) && own.count.contains(&0);
        // A mean is then no more than a sum over a count of samples.
        let is_plain = self.splats.is_none() && own.negative_count.is_empty() && !waits();
        for line in 0..height {
            let start = (line * self.width + x) as usize;
            let rows = (line * width) as usize..((line + 1) * width) as usize;
            if is_plain {
                let [red, green, blue] = [&own.r, &own.g, &own.b].map(|sums| &sums[rows.clone()]);
                let parts = red.iter().zip(green).zip(blue).zip(&own.count[rows]);
                for (at, (((&red, &green), &blue), &count)) in parts.enumerate() {
                    let sums = [red, green, blue];
                    let means = if count > 1 { sums.map(|sum| sum / f64::from(count)) } else { sums };
                    each(start + at, means.map(shown));
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
        splats.map_or(camera, |splats| [0, 1, 2].map(|channel| camera[channel] + splats[channel]))
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

    /// The index of the tile that contains a pixel, and the pixel's row in it.
    pub fn place(&self, x: u32, y: u32) -> (usize, usize) {
        let across = self.width.div_ceil(self.tile_side);
        let number = (y / self.tile_side * across + x / self.tile_side) as usize;
        let tile = &self.tiles[number].tile;
        (number, ((y - tile.y) * tile.width + (x - tile.x)) as usize)
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
                let difference = [0, 1, 2].map(|channel| mean[channel] - weighted[channel]);
                let factor = n / (weight as f64 * weight as f64);
                [0, 1, 2].map(|channel| variance[channel] / n + difference[channel] * difference[channel] * factor)
            }
            _ => variance.map(|value| value / n),
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
        let sums: usize = self.tiles.iter().map(|tile| rows(tile) * a_row + size_of::<FilmTile>()).sum();
        let moments = self.moments.iter().map(|own| own.rows() * 3 * size_of::<f64>() + size_of::<FilmMoments>());
        let planned = self.planned.iter().map(|own| own.len() * size_of::<u32>());
        let splats = self.splats.as_ref().map_or(0, FilmSplats::bytes);
        splats + sums + moments.chain(planned).chain(self.layers.iter().map(FilmLayers::bytes)).sum::<usize>()
    }
}
