//! Bounding volume hierarchies: boxes around boxes around primitives, so that a ray looks at few of them.
//!
//! Reads: a box of each primitive, and rays.
//! Gives: the leaves that a ray has to look into, the nearest first; for rays alone, in packets and as streams.
//! Space: that of the boxes, in f32; every rounding enlarges a box or an interval, so that nothing that a ray hits in
//! f64 is left out.
//!
//! What is in a leaf is not known here: shapes keep tables of rows, meshes blocks of triangles.

mod bounding_box;
mod box_packet;
mod build;
mod count;
mod entry;
mod slab_test;
mod stream;
mod traverse;
mod wide_node;

pub use bounding_box::{BoundingBox, rounded_down, rounded_up};
pub use box_packet::{BoxPacket, PACKET, PerRay, ROW, ROWS};
pub use count::{TestCounts, traverse_counted};
pub use slab_test::{BoxRay, take_first};
pub use stream::{RayStream, STREAM, StreamLeaves};
pub use traverse::{LeafTest, Stack, Traversal};
pub use wide_node::{Child, ChildKind, WIDTH, WideNode};

/// The most levels of nodes.
///
/// No path through the binary tree from which the nodes are made has more inner nodes, so none has more wide ones: as
/// soon as a set has only as many levels left as even divisions need, it is divided evenly.
pub const MAX_LEVELS: usize = 56;

/// A range of [`Bvh::order`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Range {
    /// Its first place.
    pub start: u32,
    /// The place after its last.
    pub end: u32,
}

/// A value for each axis.
///
/// `[0, 1, 2].map` is left a call where the loop around it is compiled for other instructions than the standard library
/// is: a sixth of the time of a render of 10⁶ triangles was spent in such calls.
#[inline(always)]
pub fn by_axis<T>(of: impl Fn(usize) -> T) -> [T; 3] {
    [of(0), of(1), of(2)]
}

/// A bounding volume hierarchy.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bvh {
    /// The nodes, each before its children; the first is the root.
    pub nodes: Vec<WideNode>,
    /// The leaves.
    pub leaves: Vec<Range>,
    /// The primitives' numbers, leaf by leaf.
    pub order: Vec<u32>,
    /// The box around all.
    pub around: BoundingBox,
}

impl Bvh {
    /// The numbers of a leaf's primitives.
    #[inline(always)]
    pub fn primitives(&self, leaf: usize) -> &[u32] {
        let Range { start, end } = self.leaves[leaf];
        &self.order[start as usize..end as usize]
    }

    /// The memory of its arrays, in bytes.
    pub fn bytes(&self) -> usize {
        self.nodes.len() * size_of::<WideNode>() + self.leaves.len() * size_of::<Range>() + self.order.len() * 4
    }
}

#[cfg(test)]
mod tests {
    use super::BoundingBox;
    use crate::measure::draws::Draws;
    use glam::DVec3;

    /// Boxes of one size with their lower corners at random in a cube of side 2.
    pub fn random_boxes(draws: &mut Draws, count: usize, side: f64) -> Vec<BoundingBox> {
        let mut around = || {
            let low = DVec3::from([(); 3].map(|()| draws.between(-1.0, 1.0)));
            BoundingBox::around(low, low + DVec3::splat(side))
        };
        (0..count).map(|_| around()).collect()
    }
}
