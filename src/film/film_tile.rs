use super::{FilmLayers, FilmMoments};
use crate::plan::{Column, Lane, LaneValues, Lifetime};
use crate::rays::Tile;
use bevy_ecs::prelude::*;

/// How many rejected samples a tile remembers by their address; all are counted.
const REMEMBERED: usize = 4;

/// A sample that could not join the film, because a part of it was negative or not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rejected {
    /// The pixel, from the left and from the top.
    pub pixel: [u32; 2],
    /// The sample's number within the pixel.
    pub sample: u32,
    /// The radiance, as it came.
    pub radiance: [f32; 3],
}

/// The film of one tile: sums in f64 and the count of samples, a row a pixel.
///
/// Sums are added to in the order of the samples, so neither threads nor tile size can change a bit of them.
#[derive(Component, Clone, Debug, Default, PartialEq)]
pub struct FilmTile {
    /// The pixels it covers.
    pub tile: Tile,
    /// Sum of red radiance.
    pub r: Vec<f64>,
    /// Sum of green radiance.
    pub g: Vec<f64>,
    /// Sum of blue radiance.
    pub b: Vec<f64>,
    /// Samples summed.
    pub count: Vec<u32>,
    /// How many samples could not join.
    pub rejected: u64,
    /// The first of them.
    pub first_rejected: Vec<Rejected>,
}

impl FilmTile {
    /// An empty film of a tile.
    pub fn new(tile: Tile) -> Self {
        let rows = tile.rows();
        let zeros = || vec![0.0; rows];
        Self { tile, r: zeros(), g: zeros(), b: zeros(), count: vec![0; rows], ..Self::default() }
    }

    /// Whether a sample is light: no part of it negative or not finite.
    #[inline(always)]
    pub fn takes(radiance: [f32; 3]) -> bool {
        radiance.iter().all(|&part| (0.0..f32::INFINITY).contains(&part))
    }

    /// Adds a sample to a row, or rejects it where a part is negative or not finite.
    #[inline(always)]
    pub fn add(&mut self, row: usize, radiance: [f32; 3]) {
        if Self::takes(radiance) {
            self.r[row] += f64::from(radiance[0]);
            self.g[row] += f64::from(radiance[1]);
            self.b[row] += f64::from(radiance[2]);
            self.count[row] += 1;
        } else {
            self.reject(row, radiance);
        }
    }

    #[cold]
    fn reject(&mut self, row: usize, radiance: [f32; 3]) {
        self.rejected += 1;
        if self.first_rejected.len() < REMEMBERED {
            let rejected = Rejected { pixel: self.tile.pixel_of(row), sample: self.count[row], radiance };
            self.first_rejected.push(rejected);
        }
    }

    /// The mean radiance of a row; black where no sample joined.
    pub fn mean(&self, row: usize) -> [f32; 3] {
        self.mean_f64(row).map(|part| part as f32)
    }

    /// The same, unrounded.
    #[inline(always)]
    pub fn mean_f64(&self, row: usize) -> [f64; 3] {
        let count = f64::from(self.count[row].max(1));
        [self.r[row] / count, self.g[row] / count, self.b[row] / count]
    }

    /// All lanes of sums, for checkpoints.
    pub fn sums(&self) -> [&Vec<f64>; 3] {
        [&self.r, &self.g, &self.b]
    }

    /// The same, to be filled.
    pub fn sums_mut(&mut self) -> [&mut Vec<f64>; 3] {
        [&mut self.r, &mut self.g, &mut self.b]
    }
}

impl Column for FilmTile {
    const NAME: &'static str = "pixel";
    const SPACE: &'static str = "film";
    const UNIT: &'static str = "summed linear Rec. 709";
    const LIFETIME: Lifetime = Lifetime::Film;

    fn rows(&self) -> usize {
        self.count.len()
    }

    fn lanes(&self) -> Vec<Lane<'_>> {
        vec![
            Lane { name: "r", values: LaneValues::F64(&self.r) },
            Lane { name: "g", values: LaneValues::F64(&self.g) },
            Lane { name: "b", values: LaneValues::F64(&self.b) },
            Lane { name: "count", values: LaneValues::U32(&self.count) },
        ]
    }

    fn paint(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.mean(row)
    }
}

/// The whole film: its tiles in rows of tiles, so that each can be lent to a worker.
///
/// All of it persists: it is what a checkpoint holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Film {
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom.
    pub height: u32,
    /// The side of a full tile, in pixels.
    pub tile_side: u32,
    /// The tiles, left to right, then down.
    pub tiles: Vec<FilmTile>,
    /// The second moments of each tile; none where nothing asks for them.
    pub moments: Vec<FilmMoments>,
    /// The layers of each tile; none where nothing asks for them.
    pub layers: Vec<FilmLayers>,
    /// How many steps of the render each tile has behind it.
    pub done: Vec<u32>,
    /// Whether its samples are those that only decide how many each pixel gets.
    pub pilot: bool,
    /// Samples that each pixel is to get, tile by tile, where that has been decided.
    pub planned: Vec<Vec<u32>>,
}

impl Film {
    /// An empty film, cut into tiles.
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

    /// The mean radiance of a pixel, linear Rec. 709.
    pub fn mean(&self, x: u32, y: u32) -> [f32; 3] {
        let (tile, row) = self.place(x, y);
        self.tiles[tile].mean(row)
    }

    /// The tile that holds a pixel, and the pixel's row in it.
    pub fn place(&self, x: u32, y: u32) -> (usize, usize) {
        let across = self.width.div_ceil(self.tile_side);
        let number = (y / self.tile_side * across + x / self.tile_side) as usize;
        let tile = &self.tiles[number].tile;
        (number, ((y - tile.y) * tile.width + (x - tile.x)) as usize)
    }

    /// How much the mean of a pixel would vary from one render to another with other random numbers: red, green, blue;
    /// 0 where fewer than two samples tell.
    pub fn variance_of_mean(&self, tile: usize, row: usize) -> [f64; 3] {
        let count = self.tiles[tile].count[row];
        let variance = self.moments.get(tile).map_or([0.0; 3], |moments| moments.variance(row, count));
        variance.map(|part| part / f64::from(count.max(1)))
    }

    /// All samples that could not join: how many, and the first few.
    pub fn rejected(&self) -> (u64, Vec<Rejected>) {
        let count = self.tiles.iter().map(|tile| tile.rejected).sum();
        (count, self.tiles.iter().flat_map(|tile| tile.first_rejected.iter().copied()).take(REMEMBERED).collect())
    }

    /// Bytes that its sums and counts take, and what holds them together.
    pub fn bytes(&self) -> usize {
        let a_row = 3 * size_of::<f64>() + size_of::<u32>();
        self.tiles.iter().map(|tile| tile.rows() * a_row + size_of::<FilmTile>()).sum()
    }
}
