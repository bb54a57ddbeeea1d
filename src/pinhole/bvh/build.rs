//! The builder: a binary tree by the surface area heuristic, and then the cheapest wide nodes that can be made of it.

use super::binary_tree::{BinaryNode, binary_tree};
use super::bounding_box::BoundingBox;
use super::entry::{Entry, Extent};
use super::wide_node::{Child, WIDTH, WideNode};
use super::{Bvh, Range};
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
