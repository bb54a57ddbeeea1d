//! The surface area heuristic over bins: where a set of entries is divided.

use super::entry::{Entry, Extent, PackedBox};
use multiversion::multiversion;

/// The most bins of centres along an axis among which a division is chosen.
const BINS: usize = 16;
/// Sets smaller than this are divided among half as many bins.
const FEW: usize = 32;
/// Sets of at least this many entries are sorted into bins in parallel.
const MANY: usize = 1 << 16;

/// From a doubled centre to its bin along each axis: (c − base) · scale, rounded down or so.
struct Grid {
    base: [f32; 4],
    scale: [f32; 4],
    used: usize,
}

impl Grid {
    #[inline(always)]
    fn of(centres: &PackedBox, count: usize) -> Self {
        let used = if count < FEW { BINS / 2 } else { BINS };
        let mut grid = Self { base: [0.0; 4], scale: [0.0; 4], used };
        for axis in 0..3 {
            let extent = centres.extent(axis);
            let scale = used as f32 * 0.9999 / extent;
            grid.base[axis] = centres.0[axis];
            grid.scale[axis] = if extent > 0.0 && scale < f32::MAX { scale } else { 0.0 };
        }
        grid
    }

    /// The bin of an entry along one axis, a number below [`BINS`] whatever the box.
    ///
    /// Adding 1.5 · 2²³ rounds to a whole number and leaves it in the last bits of the sum, on all axes with the same
    /// few instructions.
    #[inline(always)]
    fn bin(&self, Entry(PackedBox(entry)): &Entry, axis: usize) -> u32 {
        let place = ((entry[axis] - entry[axis + 4]) - self.base[axis]) * self.scale[axis] - 0.5;
        (place + 12_582_912.0).to_bits() & (BINS as u32 - 1)
    }
}

/// The boxes and the counts of the entries in each bin, by axis.
#[derive(Clone)]
pub struct Bins {
    around: [[PackedBox; BINS]; 3],
    count: [[u32; BINS]; 3],
}

impl Bins {
    /// No entries.
    pub const EMPTY: Self = Self { around: [[PackedBox::EMPTY; BINS]; 3], count: [[0; BINS]; 3] };

    #[inline(always)]
    fn clear(&mut self, used: usize) {
        for axis in 0..3 {
            self.around[axis][..used].fill(PackedBox::EMPTY);
            self.count[axis] = [0; BINS];
        }
    }

    #[inline(always)]
    fn add(&mut self, entries: &[Entry], grid: &Grid) {
        for entry in entries {
            let bins: [u32; 4] = std::array::from_fn(|axis| grid.bin(entry, axis));
            for (axis, bin) in bins.into_iter().enumerate().take(3) {
                let bin = bin as usize % BINS;
                let (old, new) = (self.around[axis][bin].0, entry.0.0);
                // Without + 0.0, which changes no value, the minimum would be stored under the mask of the comparison,
                // and the next load from there would have to wait for that.
                let min = std::array::from_fn(|i| (if new[i] < old[i] { new[i] } else { old[i] }) + 0.0);
                self.around[axis][bin] = PackedBox(min);
                self.count[axis][bin] += 1;
            }
        }
    }

    /// The bins of many entries, each half on its own; minima and counts do not depend on the order.
    fn of_many(entries: &[Entry], grid: &Grid) -> Self {
        if entries.len() < MANY {
            return bins_of(entries, grid);
        }
        let (low, high) = entries.split_at(entries.len() / 2);
        let (mut bins, other) = rayon::join(|| Self::of_many(low, grid), || Self::of_many(high, grid));
        for axis in 0..3 {
            for bin in 0..BINS {
                bins.around[axis][bin].enclose(&other.around[axis][bin]);
                bins.count[axis][bin] += other.count[axis][bin];
            }
        }
        bins
    }

    // ANCHOR: best_division
    /// The division of least cost, as its axis and the first bin above it: each part's area, to which the probability
    /// of a visit is proportional, times the work of a visit, which is one leaf test for every `LEAF` primitives.
    #[inline(always)]
    fn best_division<const LEAF: usize>(&self, grid: &Grid) -> Option<(usize, u32)> {
        let cost_of = |around: &PackedBox, count: u32| match count {
            0 => f32::INFINITY,
            _ => around.half_area() * count.div_ceil(LEAF as u32) as f32,
        };
        let (mut best, mut min) = (None, f32::INFINITY);
        for axis in (0..3).filter(|&axis| grid.scale[axis] > 0.0) {
            let (boxes, counts) = (&self.around[axis], &self.count[axis]);
            let mut above = [f32::INFINITY; BINS];
            let (mut around, mut count) = (PackedBox::EMPTY, 0);
            for bin in (1..grid.used).rev() {
                around.enclose(&boxes[bin]);
                count += counts[bin];
                above[bin] = cost_of(&around, count);
            }
            let (mut around, mut count) = (PackedBox::EMPTY, 0);
            for bin in 1..grid.used {
                around.enclose(&boxes[bin - 1]);
                count += counts[bin - 1];
                let cost = cost_of(&around, count) + above[bin];
                if cost < min {
                    (best, min) = (Some((axis, bin as u32)), cost);
                }
            }
        }
        best
    }
    // ANCHOR_END: best_division
}

/// Divides a set in two, the lower part first: where the heuristic says, or in the middle of the list where all centres
/// are in one place or it has to be even.
///
/// The parts' extents come with the place of the division; `bins` is room that is used again and again.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn divide<const LEAF: usize>(
    entries: &mut [Entry],
    extent: &Extent,
    bins: &mut Bins,
    even: bool,
) -> (usize, [Extent; 2]) {
    let mut middle = entries.len() / 2;
    if !even {
        let grid = Grid::of(&extent.centres, entries.len());
        if entries.len() < MANY {
            bins.clear(grid.used);
            bins.add(entries, &grid);
        } else {
            *bins = Bins::of_many(entries, &grid);
        }
        if let Some((axis, first_above)) = bins.best_division::<LEAF>(&grid) {
            // Without a branch: every entry is swapped to the end of the lower part, which then grows or does not.
            middle = 0;
            for place in 0..entries.len() {
                let entry = entries[place];
                let is_below = grid.bin(&entry, axis) < first_above;
                entries[place] = entries[middle];
                entries[middle] = entry;
                middle += usize::from(is_below);
            }
        }
    }
    let (low, high) = entries.split_at(middle);
    (middle, [Extent::of(low), Extent::of(high)])
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn bins_of(entries: &[Entry], grid: &Grid) -> Bins {
    let mut bins = Bins::EMPTY;
    bins.add(entries, grid);
    bins
}
