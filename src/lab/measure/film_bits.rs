//! A film as bits, so that equal means equal.

use bevy_ecs::prelude::*;
use pinhole::Result;
use pinhole::film::{Film, FilmTile};
use pinhole::plan::Stage;
use pinhole::render::{Execution, render};
use pinhole::scene::{FNV_BASIS, fnv};

/// A film pixel by pixel: the bits of three weighted sums, and the counts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilmBits {
    /// Pixels from left to right.
    pub width: u32,
    /// Line by line from the top.
    pub pixels: Vec<[u64; 4]>,
    /// Samples that could not join.
    pub rejected: u64,
}

impl FilmBits {
    /// The bits of a whole film.
    pub fn of(film: &Film) -> Self {
        let mut bits = Self::of_tiles(film.width, film.height, film.tiles.iter());
        if let Some(splats) = &film.splats {
            let [r, g, b] = &splats.sums;
            let sums = r.iter().zip(g).zip(b).map(|((r, g), b)| [r.to_bits(), g.to_bits(), b.to_bits(), splats.paths]);
            bits.pixels.extend(sums);
            bits.rejected += splats.rejected;
        }
        bits
    }

    /// The bits of a film by its tiles, in any order.
    ///
    /// # Panics
    /// When two tiles hold the same pixel.
    pub fn of_tiles<'f>(width: u32, height: u32, tiles: impl Iterator<Item = &'f FilmTile>) -> Self {
        let mut pixels = vec![[u64::MAX; 4]; width as usize * height as usize];
        let mut rejected = 0;
        for tile in tiles {
            rejected += tile.rejected;
            for row in 0..tile.count.len() {
                let [x, y] = tile.tile.pixel_of(row);
                let sums = tile.weighted_sums(row).map(f64::to_bits);
                let negative = tile.negative_count.get(row).copied().unwrap_or(0);
                let pixel = &mut pixels[(y * width + x) as usize];
                assert_eq!(*pixel, [u64::MAX; 4], "two tiles hold the pixel {x},{y}");
                *pixel = [sums[0], sums[1], sums[2], u64::from(tile.count[row]) | (u64::from(negative) << 32)];
            }
        }
        Self { width, pixels, rejected }
    }

    /// A digest of all bits, in the order of the pixels.
    pub fn digest(&self) -> u64 {
        digest(self.pixels.iter().flatten().copied())
    }

    /// How many different pixels it has: a picture of one colour proves little.
    pub fn colours(&self) -> usize {
        self.pixels.iter().collect::<std::collections::BTreeSet<_>>().len()
    }

    /// How this film differs from what is expected, by the first pixel that does; nothing where every bit is the same.
    pub fn difference(&self, expected: &Self) -> Option<String> {
        if self.pixels.len() != expected.pixels.len() {
            return Some(format!("{} pixels instead of {}", self.pixels.len(), expected.pixels.len()));
        }
        let differ = |pixel: &usize| self.pixels[*pixel] != expected.pixels[*pixel];
        let wrong: Vec<usize> = (0..self.pixels.len()).filter(differ).collect();
        if let Some(&first) = wrong.first() {
            let (x, y) = (first as u32 % self.width, first as u32 / self.width);
            let shown = |bits: [u64; 4]| ([bits[0], bits[1], bits[2]].map(f64::from_bits), bits[3]);
            let (expected, found) = (shown(expected.pixels[first]), shown(self.pixels[first]));
            let (wrong, all) = (wrong.len(), self.pixels.len());
            return Some(format!("{wrong} of {all} pixels differ, first {x},{y}: {expected:?} became {found:?}"));
        }
        let rejected = [self.rejected, expected.rejected];
        (rejected[0] != rejected[1]).then(|| format!("{} samples rejected instead of {}", rejected[0], rejected[1]))
    }

    /// Asks that every bit is the same.
    ///
    /// # Panics
    /// When one is not; the first pixel that differs is named.
    pub fn assert_is(&self, expected: &Self, what: &str) {
        let difference = self.difference(expected);
        assert!(difference.is_none(), "{what}: {}", difference.unwrap_or_default());
    }
}

/// The digest of a scene's film, in sixteen hexadecimal digits: errors that were measured and are kept belong to it.
///
/// Errors: what a render would be refused for.
pub fn film_digest(scene: &World, offer: &[Stage]) -> Result<String> {
    let film = render(scene, offer, &Execution::default(), &())?.film;
    Ok(format!("{:016x}", FilmBits::of(&film).digest()))
}

/// FNV-1a over the bytes of some words.
pub fn digest(words: impl Iterator<Item = u64>) -> u64 {
    words.fold(FNV_BASIS, |hash, word| fnv(hash, &word.to_le_bytes()))
}
