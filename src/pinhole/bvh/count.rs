//! The work of a traversal, counted: the steps of a render in a loop of its own, so that those of a render count nothing.

use super::Bvh;
use super::traverse::{LeafTest, ROOM, Stack, Traversal};
use super::wide_node::ChildKind;

/// What one ray is tested against.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TestCounts {
    /// Boxes: the children of all nodes that it visits.
    pub boxes: u32,
    /// Primitives: shapes that are not meshes, and the triangles of meshes.
    pub primitives: u32,
    /// The nodes on the longest path from a root down to a node that it visits, where hierarchies lie within each other
    /// those of both.
    pub depth: u32,
}

/// What is done in a leaf: it is given the leaf's number, the nodes above it and the counts, and gives the smallest t so
/// far.
struct CountedLeaf<'a, F> {
    test: &'a mut F,
    above: u32,
    counts: &'a mut TestCounts,
}

impl<F: FnMut(usize, u32, &mut TestCounts) -> f64> LeafTest for CountedLeaf<'_, F> {
    fn test(&mut self, leaf: usize) -> f64 {
        (self.test)(leaf, self.above, self.counts)
    }
}

/// Visits what [`traverse`](super::traverse()) visits for the closest hit, and counts it; `above` nodes of another
/// hierarchy are above this one.
pub fn traverse_counted(
    bvh: &Bvh,
    mut traversal: Traversal,
    above: u32,
    counts: &mut TestCounts,
    mut test: impl FnMut(usize, u32, &mut TestCounts) -> f64,
) {
    let (mut stack, mut above_entry, mut above) = (Stack::default(), [0; ROOM], above);
    loop {
        let node = match traversal.at().kind() {
            ChildKind::Node(number) => Some(&bvh.nodes[number]),
            ChildKind::Leaf(_) => None,
        };
        if let Some(node) = node {
            counts.boxes += node.children() as u32;
            counts.depth = counts.depth.max(above + 1);
        }
        let base = traversal.height();
        let mut leaves = CountedLeaf { test: &mut test, above, counts: &mut *counts };
        if !traversal.step(false, bvh, &mut stack, &mut leaves) {
            return;
        }
        let height = traversal.height();
        if node.is_some() && height >= base {
            // The nearest child is next, and the others were put on the stack.
            above += 1;
            above_entry[base..height].fill(above);
        } else {
            above = above_entry[height];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bvh::{Child, tests::random_boxes};
    use crate::measure::draws::Draws;
    use glam::DVec3;

    /// The levels of all nodes, from the top down.
    fn levels(bvh: &Bvh) -> Vec<u32> {
        let mut levels = vec![1; bvh.nodes.len()];
        for (number, node) in bvh.nodes.iter().enumerate() {
            for child in node.child {
                if let (false, ChildKind::Node(below)) = (child == Child::NONE, child.kind()) {
                    levels[below] = levels[number] + 1;
                }
            }
        }
        levels
    }

    /// A ray that hits nothing visits every node whose box it enters, in whatever order: an independent count.
    #[test]
    fn a_ray_that_hits_nothing_visits_what_its_boxes_say() {
        let mut draws = Draws::new(3041, 0);
        let boxes = random_boxes(&mut draws, 3000, 0.05);
        let bvh = Bvh::build::<4>(&boxes);
        let levels = levels(&bvh);
        let (rays, mut deepest) = (2000, 0);
        for _ in 0..rays {
            let origin = DVec3::from([(); 3].map(|()| draws.between(-2.0, 2.0)));
            let ray = [origin, draws.unit_vector()];
            let (mut expected, mut open, mut leaves) = (TestCounts::default(), vec![0], Vec::new());
            while let Some(number) = open.pop() {
                let node = &bvh.nodes[number];
                expected.depth = expected.depth.max(levels[number]);
                let box_ray = crate::bvh::BoxRay::new(ray[0], ray[1], &bvh.around);
                let mut mask = box_ray.enters(node, f32::INFINITY, &mut [0.0; 8]);
                expected.boxes += node.children() as u32;
                while mask != 0 {
                    match node.child[crate::bvh::take_first(&mut mask)].kind() {
                        ChildKind::Node(number) => open.push(number),
                        ChildKind::Leaf(leaf) => leaves.push(leaf),
                    }
                }
            }
            let traversal = Traversal::new(&bvh, ray, f64::INFINITY).expect("a finite ray");
            let (mut counts, mut visited) = (TestCounts::default(), Vec::new());
            traverse_counted(&bvh, traversal, 0, &mut counts, |leaf, _, _| {
                visited.push(leaf);
                f64::INFINITY
            });
            leaves.sort_unstable();
            visited.sort_unstable();
            assert_eq!((counts, visited), (expected, leaves), "{ray:?}");
            deepest = deepest.max(counts.depth);
        }
        assert_eq!(deepest, levels.into_iter().max().unwrap_or(0), "some ray gets to the bottom");
        eprintln!("counts: {rays} rays, down to level {deepest}");
    }
}
