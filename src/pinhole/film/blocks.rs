//! Sums in blocks of samples, so that parts of a picture that are rendered apart add up to the same bits.
//!
//! A sum of floating-point numbers depends on the order in which they are added.
//! Therefore a pixel's samples are summed block by block, each block from zero and in the order of its samples, and the
//! sums of the blocks are added in their order.
//! Whoever sums a block alone gets the same number, and adding it in its turn gives the same bits.

use super::{FilmLayers, FilmMoments, FilmTile, Rejected};
use crate::each::Each;
use crate::plan::{Column, VectorRows};

/// The number of samples of a pixel that are summed from zero.
///
/// A render of so many samples or fewer has one block, and keeps no sums of earlier ones.
pub const BLOCK: u32 = 64;

/// The sums over the blocks of samples before the one in progress, with a row per pixel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EarlierBlocks {
    /// Sums of red, green and blue radiance.
    pub sum: [Vec<f64>; 3],
    /// Number of samples summed.
    pub count: Vec<u32>,
    /// Sums of the samples on a negative lobe of the filter; empty before the first.
    pub negative: [Vec<f64>; 3],
}

/// Adds the sums of one list to those of another that may still be empty, and leaves zeros.
fn pass_on(sums: &mut [f64], into: &mut Vec<f64>) {
    into.resize(sums.len(), 0.0);
    into.iter_mut().zip(&mut *sums).for_each(|(into, sum)| *into += *sum);
    sums.fill(0.0);
}

/// Adds numbers to others that may still be missing.
fn add_counts(counts: &[u32], into: &mut Vec<u32>) {
    into.resize(into.len().max(counts.len()), 0);
    into.iter_mut().zip(counts).for_each(|(into, count)| *into += count);
}

impl FilmTile {
    /// Ends a block of samples: what is summed next is summed from zero.
    pub fn end_block(&mut self) {
        let earlier = self.earlier.get_or_insert_default();
        self.sum.iter_mut().zip(&mut earlier.sum).for_each(|(sum, into)| pass_on(sum, into));
        self.negative.iter_mut().zip(&mut earlier.negative).for_each(|(sum, into)| pass_on(sum, into));
        earlier.count.clone_from(&self.count);
    }

    /// The sums of a row over all blocks.
    #[inline(always)]
    pub fn sums(&self, row: usize) -> [f64; 3] {
        let [r, g, b] = self.sum.at(row);
        let Some(earlier) = &self.earlier else { return [r, g, b] };
        let [before_r, before_g, before_b] = earlier.sum.at(row);
        [before_r + r, before_g + g, before_b + b]
    }

    /// The sum of a row over the samples on a negative lobe of the filter, in all blocks.
    #[inline(always)]
    pub(super) fn negative_sum(&self, channel: usize, row: usize) -> f64 {
        let of = |negative: &[Vec<f64>; 3]| negative[channel].get(row).copied().unwrap_or(0.0);
        let own = of(&self.negative);
        self.earlier.as_ref().map_or(own, |earlier| of(&earlier.negative) + own)
    }

    /// Sums and numbers of a row's samples in the last block and in all before it; none where either has none.
    pub fn blocks_of(&self, row: usize) -> Option<[([f64; 3], u32); 2]> {
        let earlier = self.earlier.as_ref()?;
        let (last, before) = (self.count_in_block(row), earlier.count[row]);
        (last > 0 && before > 0).then(|| [(self.sum.at(row), last), (earlier.sum.at(row), before)])
    }

    /// The number of a row's samples in the block in progress.
    #[inline(always)]
    pub(super) fn count_in_block(&self, row: usize) -> u32 {
        self.count[row] - self.earlier.as_ref().map_or(0, |earlier| earlier.count[row])
    }

    /// Adds a block of samples that was summed apart, and comes next.
    pub fn append(&mut self, block: &Self) {
        self.end_block();
        for (into, sum) in self.sum.iter_mut().zip(&block.sum) {
            into.clone_from(sum);
        }
        for (into, sum) in self.negative.iter_mut().zip(&block.negative) {
            if !sum.is_empty() {
                into.clone_from(sum);
            }
        }
        for rejected in &block.first_rejected {
            let [x, y] = rejected.pixel;
            let row = (y - self.tile.y) * self.tile.width + (x - self.tile.x);
            self.remember(Rejected { sample: rejected.sample + self.count[row as usize], ..*rejected });
        }
        self.rejected += block.rejected;
        add_counts(&block.count, &mut self.count);
        if !block.negative_count.is_empty() {
            add_counts(&block.negative_count, &mut self.negative_count);
        }
    }

    /// The memory of the sums of earlier blocks, in bytes.
    pub(super) fn earlier_bytes(&self) -> usize {
        let of = |own: &EarlierBlocks| {
            let sums = own.sum.iter().chain(&own.negative).map(|sum| size_of_val(&sum[..])).sum::<usize>();
            sums + size_of_val(&own.count[..]) + size_of::<EarlierBlocks>()
        };
        self.earlier.as_deref().map_or(0, of)
    }
}

impl FilmMoments {
    /// Ends a block of samples of this film, which has not been told yet.
    pub fn end_block(&mut self, film: &FilmTile) {
        let rows = self.rows();
        let all: Vec<[f64; 3]> = (0..rows).map(|row| self.squares(film, row)).collect();
        for (channel, (earlier, sum)) in self.earlier.iter_mut().zip(&mut self.sum).enumerate() {
            earlier.clear();
            earlier.extend(all.iter().map(|own| own[channel]));
            sum.fill(0.0);
        }
    }

    /// The sums of the squared deviations of a row over all blocks, from the means of all of its samples.
    ///
    /// Those of two sets of samples are joined by the formula of Chan, Golub and LeVeque ("Updating formulae and a
    /// pairwise algorithm for computing sample variances", 1979): M = M₁ + M₂ + δ² n₁ n₂ / (n₁ + n₂), where δ is the
    /// difference of the means.
    pub(super) fn squares(&self, film: &FilmTile, row: usize) -> [f64; 3] {
        let own = self.sum.at(row);
        let (Some(earlier), false) = (&film.earlier, self.earlier[0].is_empty()) else { return own };
        let (before, n) = (f64::from(earlier.count[row]), f64::from(film.count_in_block(row)));
        let squares = self.earlier.at(row);
        if n == 0.0 || before == 0.0 {
            return [0, 1, 2].each(|channel| squares[channel] + own[channel]);
        }
        let (sums, sums_before) = (film.sum.at(row), earlier.sum.at(row));
        [0, 1, 2].each(|channel| {
            let apart = sums[channel] / n - sums_before[channel] / before;
            squares[channel] + own[channel] + apart * apart * (before * n / (before + n))
        })
    }

    /// Adds a block that was summed apart and comes next to the film, which does not have it yet.
    pub fn append(&mut self, film: &FilmTile, block: &Self) {
        self.end_block(film);
        self.sum.clone_from(&block.sum);
    }
}

impl FilmLayers {
    /// Ends a block of samples.
    pub fn end_block(&mut self) {
        self.earlier.resize(self.sums.len(), Vec::new());
        self.sums.iter_mut().zip(&mut self.earlier).for_each(|(sum, into)| pass_on(sum, into));
    }

    /// Adds a block that was summed apart, and comes next.
    pub fn append(&mut self, block: &Self) {
        self.end_block();
        self.sums.clone_from(&block.sums);
        for (row, &entity) in block.entity.iter().enumerate() {
            if self.taken[row] == 0 {
                self.entity[row] = entity;
            }
        }
        block.mattes.iter().for_each(|(place, count)| *self.mattes.entry(*place).or_default() += count);
        add_counts(&block.taken, &mut self.taken);
        add_counts(&block.hits, &mut self.hits);
    }

    /// The sum of a component at a row, over all blocks.
    pub(super) fn sum(&self, component: usize, row: usize) -> f64 {
        let own = self.sums[component][row];
        self.earlier.get(component).map_or(own, |earlier| earlier[row] + own)
    }
}
