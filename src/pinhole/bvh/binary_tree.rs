//! The binary tree from which the wide nodes are made, and what each of its nodes would cost as part of a wide one.

use super::MAX_LEVELS;
use super::bins::{Bins, divide};
use super::entry::{Entry, Extent, PackedBox};
use super::wide_node::WIDTH;

/// Sets of at least this many entries are divided in parallel.
const TASK: usize = 2048;

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
    if entries.len() < TASK {
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
