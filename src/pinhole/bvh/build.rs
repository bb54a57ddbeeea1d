//! The builder: a binary tree by the surface area heuristic, and then the cheapest wide nodes that can be made of it.

use super::bounding_box::BoundingBox;
use super::entry::{Entry, Extent, PackedBox};
use super::wide_node::{Child, WIDTH, WideNode};
use super::{Bvh, MAX_LEVELS, Range};
use crate::each::lanes;
use multiversion::multiversion;
use rayon::prelude::*;

/// The fewest boxes that are worth a task of their own.
const TASK: usize = 4096;

impl Bvh {
    /// Builds the hierarchy of primitives with these boxes, at most `LEAF` of them to a leaf.
    ///
    /// It is the same, bit for bit, on any number of threads.
    pub fn build<const LEAF: usize>(boxes: &[BoundingBox]) -> Self {
        let numbered = boxes.par_iter().with_min_len(TASK).enumerate();
        let mut entries: Vec<Entry> = numbered.map(|(number, around)| Entry::new(around, number as u32)).collect();
        let extent = Extent::of(&entries);
        let mut bvh = Self { around: extent.around.unpacked(), ..Self::default() };
        if entries.is_empty() {
            bvh.nodes.push(WideNode::empty());
            return bvh;
        }
        let tree = binary_tree::<LEAF>(&mut entries, &extent);
        bvh.leaves.reserve(entries.len() / 3);
        bvh.nodes.reserve(entries.len() / 16);
        bvh.add_wide_node(&tree, 0);
        bvh.order = entries.iter().map(Entry::number).collect();
        bvh
    }

    /// Makes the wide node of a binary one, and those below it; gives its number.
    fn add_wide_node(&mut self, tree: &[BinaryNode], root: usize) -> usize {
        let (mut children, mut count) = ([0; WIDTH], 0);
        collect_children(tree, root, WIDTH, &mut children, &mut count);
        let number = self.nodes.len();
        self.nodes.push(WideNode::empty());
        let mut node = WideNode::empty();
        // The leaves first, so that those of a node are next to one another in memory.
        for (place, &child) in children[..count].iter().enumerate() {
            let BinaryNode { around, link, count, .. } = tree[child];
            if count > 0 {
                self.leaves.push(Range { start: link, end: link + count });
                node.set(place, Child::leaf(self.leaves.len() - 1), &around.unpacked());
            }
        }
        for (place, &child) in children[..count].iter().enumerate() {
            if tree[child].is_inner() {
                let below = self.add_wide_node(tree, child);
                node.set(place, Child::node(below), &tree[child].around.unpacked());
            }
        }
        self.nodes[number] = node;
        number
    }
}

/// The binary nodes that fill the slots of a wide one, in the order of the tree.
fn collect_children(tree: &[BinaryNode], node: usize, slots: usize, children: &mut [usize; WIDTH], count: &mut usize) {
    match tree[node].division(slots) {
        None => {
            children[*count] = node;
            *count += 1;
        }
        Some([of_lower, of_upper]) => {
            collect_children(tree, node + 1, of_lower, children, count);
            collect_children(tree, node + tree[node].link as usize, of_upper, children, count);
        }
    }
}

// The surface area heuristic over bins: where a set of entries is divided.

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
            let bins: [u32; 4] = lanes(|axis| grid.bin(entry, axis));
            for (axis, bin) in bins.into_iter().enumerate().take(3) {
                let bin = bin as usize % BINS;
                let (old, new) = (self.around[axis][bin].0, entry.0.0);
                // Without + 0.0, which changes no value, the minimum would be stored under the mask of the comparison,
                // and the next load from there would have to wait for that.
                let min = lanes(|i| (if new[i] < old[i] { new[i] } else { old[i] }) + 0.0);
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

// The binary tree from which the wide nodes are made, and what each of its nodes would cost as part of a wide one.

/// Sets of at least this many entries are divided in parallel.
const TREE_TASK: usize = 2048;

/// A node of the binary tree, which is kept depth first: its lower child follows it.
#[derive(Clone, Copy, Debug)]
pub struct BinaryNode {
    /// The box around its primitives.
    pub around: PackedBox,
    /// The first entry of a leaf; otherwise how far behind it its upper child is.
    pub link: u32,
    /// The entries of a leaf; otherwise 0.
    pub count: u32,
    /// How many of the first `slots` slots its lower child gets, by `slots`; 0 where one slot fewer is as good.
    slots_of_lower: [u8; WIDTH + 1],
}

/// The least summed area of the wide nodes below a node, by the number of slots it may take in a wide node above.
type Costs = [f32; WIDTH + 1];

impl BinaryNode {
    fn leaf(around: PackedBox, first: usize, count: usize) -> (Self, Costs) {
        let node = Self { around, link: first as u32, count: count as u32, slots_of_lower: [0; WIDTH + 1] };
        (node, [0.0; WIDTH + 1])
    }

    // ANCHOR: inner
    /// An inner node: its costs follow from its children's, which is what makes this dynamic programming.
    ///
    /// With two slots or more it may hand them to its children, in whatever division costs least; with one it becomes a
    /// wide node of its own, with eight slots for its children, at the cost of its area.
    fn inner(around: PackedBox, link: usize, lower: &Costs, upper: &Costs) -> (Self, Costs) {
        let mut costs = [f32::INFINITY; WIDTH + 1];
        let mut slots_of_lower = [0; WIDTH + 1];
        // Even if the areas overflow, there are two children.
        slots_of_lower[2] = 1;
        for slots in 2..=WIDTH {
            costs[slots] = costs[slots - 1];
            for of_lower in 1..slots {
                let cost = lower[of_lower] + upper[slots - of_lower];
                if cost < costs[slots] {
                    (costs[slots], slots_of_lower[slots]) = (cost, of_lower as u8);
                }
            }
        }
        let own = around.half_area() + costs[WIDTH];
        costs[1] = own;
        for slots in 2..WIDTH {
            if own < costs[slots] {
                (costs[slots], slots_of_lower[slots]) = (own, 0);
            }
        }
        (Self { around, link: link as u32, count: 0, slots_of_lower }, costs)
    }
    // ANCHOR_END: inner

    /// Whether it has children.
    pub fn is_inner(&self) -> bool {
        self.count == 0
    }

    /// How `slots` slots are divided among its children; none where it takes one slot itself.
    pub fn division(&self, mut slots: usize) -> Option<[usize; 2]> {
        while slots > 1 && self.slots_of_lower[slots] == 0 {
            slots -= 1;
        }
        let of_lower = usize::from(self.slots_of_lower[slots]);
        (self.is_inner() && slots > 1).then_some([of_lower, slots - of_lower])
    }
}

/// A part of the tree: made in one go, or of two parts that were made in parallel.
///
/// Which of both depends only on the number of entries, so the tree is the same on any number of threads.
enum Subtree {
    Whole(Vec<BinaryNode>),
    Halves(BinaryNode, Box<[Subtree; 2]>),
}

impl Subtree {
    fn len(&self) -> usize {
        match self {
            Self::Whole(nodes) => nodes.len(),
            Self::Halves(_, halves) => 1 + halves[0].len() + halves[1].len(),
        }
    }

    fn append_to(self, nodes: &mut Vec<BinaryNode>) {
        match self {
            Self::Whole(own) => nodes.extend_from_slice(&own),
            Self::Halves(node, halves) => {
                nodes.push(node);
                halves.into_iter().for_each(|half| half.append_to(nodes));
            }
        }
    }
}

// ANCHOR: must_be_even
/// Whether a set has to be divided evenly, so that no path has more than [`MAX_LEVELS`] inner nodes.
///
/// Even divisions of n entries need ⌈log₂ ⌈n / LEAF⌉⌉ levels; an uneven one may leave almost as many entries to one
/// child, one level further down.
fn must_be_even<const LEAF: usize>(count: usize, level: usize) -> bool {
    let even_levels = usize::BITS - (count.div_ceil(LEAF) - 1).leading_zeros();
    level + even_levels as usize >= MAX_LEVELS
}
// ANCHOR_END: must_be_even

/// The binary tree over these entries, which are put in the order of its leaves.
pub fn binary_tree<const LEAF: usize>(entries: &mut [Entry], extent: &Extent) -> Vec<BinaryNode> {
    let (subtree, _) = subtree::<LEAF>(entries, 0, extent, 0);
    let mut nodes = Vec::with_capacity(subtree.len());
    subtree.append_to(&mut nodes);
    nodes
}

fn subtree<const LEAF: usize>(entries: &mut [Entry], first: usize, extent: &Extent, level: usize) -> (Subtree, Costs) {
    let mut bins = Bins::EMPTY;
    if entries.len() < TREE_TASK {
        let mut nodes = Vec::with_capacity(entries.len());
        let costs = add_subtree::<LEAF>(entries, first, extent, level, &mut bins, &mut nodes);
        return (Subtree::Whole(nodes), costs);
    }
    let even = must_be_even::<LEAF>(entries.len(), level);
    let (middle, [of_lower, of_upper]) = divide::<LEAF>(entries, extent, &mut bins, even);
    let (lower, upper) = entries.split_at_mut(middle);
    let ((lower, lower_costs), (upper, upper_costs)) = rayon::join(
        || subtree::<LEAF>(lower, first, &of_lower, level + 1),
        || subtree::<LEAF>(upper, first + middle, &of_upper, level + 1),
    );
    let (node, costs) = BinaryNode::inner(extent.around, 1 + lower.len(), &lower_costs, &upper_costs);
    (Subtree::Halves(node, Box::new([lower, upper])), costs)
}

fn add_subtree<const LEAF: usize>(
    entries: &mut [Entry],
    first: usize,
    extent: &Extent,
    level: usize,
    bins: &mut Bins,
    nodes: &mut Vec<BinaryNode>,
) -> Costs {
    let number = nodes.len();
    let (leaf, costs) = BinaryNode::leaf(extent.around, first, entries.len());
    nodes.push(leaf);
    if entries.len() <= LEAF {
        return costs;
    }
    let even = must_be_even::<LEAF>(entries.len(), level);
    let (middle, [of_lower, of_upper]) = divide::<LEAF>(entries, extent, bins, even);
    let (lower, upper) = entries.split_at_mut(middle);
    let lower_costs = add_subtree::<LEAF>(lower, first, &of_lower, level + 1, bins, nodes);
    let link = nodes.len() - number;
    let upper_costs = add_subtree::<LEAF>(upper, first + middle, &of_upper, level + 1, bins, nodes);
    let (node, costs) = BinaryNode::inner(extent.around, link, &lower_costs, &upper_costs);
    nodes[number] = node;
    costs
}
