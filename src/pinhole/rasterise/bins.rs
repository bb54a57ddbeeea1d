//! The image is divided into square bins, and each of them lists what may cover some of its pixels.

use crate::each::Each;
use crate::rays::Tile;
use glam::DVec2;

/// The side of a bin, in pixels.
pub(super) const BIN: u32 = 32;

/// The first and last pixel to the right and downward.
pub(super) type Extent = [[u32; 2]; 2];

/// How many bins an image has from left to right and from top to bottom.
pub(super) fn bins_of(size: DVec2) -> [u32; 2] {
    [size.x, size.y].each(|pixels| (pixels as u32).div_ceil(BIN))
}

/// The columns and lines of the bins that a tile overlaps, line by line.
pub(super) fn bins_near(tile: &Tile) -> impl Iterator<Item = [u32; 2]> + use<> {
    let bins = |start: u32, count: u32| start / BIN..=(start + count.max(1) - 1) / BIN;
    let (columns, lines) = (bins(tile.x, tile.width), bins(tile.y, tile.height));
    lines.flat_map(move |line| columns.clone().map(move |column| [column, line]))
}

/// The lists of all bins.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Bins {
    across: u32,
    /// Where the list of each bin starts, line by line, and where the last one ends.
    starts: Vec<u32>,
    /// The places of what is in one bin after another, each list in ascending order.
    lists: Vec<u32>,
}

impl Bins {
    /// Sorts extents into so many bins, each of which keeps their order.
    pub fn sorted(extents: &[Extent], [across, down]: [u32; 2]) -> Self {
        let bins_of = |extent: &Extent| {
            let [columns, lines] = extent.each(|[first, last]| first / BIN..=last / BIN);
            lines.flat_map(move |line| columns.clone().map(move |column| (line * across + column) as usize))
        };
        let mut starts = vec![0_u32; (across * down) as usize + 1];
        extents.iter().flat_map(bins_of).for_each(|bin| starts[bin + 1] += 1);
        for bin in 1..starts.len() {
            starts[bin] += starts[bin - 1];
        }
        let mut next = starts.clone();
        let mut lists = vec![0; starts[starts.len() - 1] as usize];
        for (place, extent) in extents.iter().enumerate() {
            for bin in bins_of(extent) {
                lists[next[bin] as usize] = place as u32;
                next[bin] += 1;
            }
        }
        Self { across, starts, lists }
    }

    /// The places of what is in the bin of a column and a line.
    pub fn list(&self, [column, line]: [u32; 2]) -> &[u32] {
        let bin = (line * self.across + column) as usize;
        &self.lists[self.starts[bin] as usize..self.starts[bin + 1] as usize]
    }

    /// The memory of its arrays, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.starts[..]) + size_of_val(&self.lists[..])
    }
}
