use super::bounding_box::BoundingBox;
use super::by_axis;

use crate::each::Each;

/// The children of a node.
pub const WIDTH: usize = 8;
/// Marks a child that is a leaf.
const LEAF: u32 = 1 << 31;

/// A child of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Child(u32);

/// What a child is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChildKind {
    /// The node with this number.
    Node(usize),
    /// The leaf with this number.
    Leaf(usize),
}

impl Child {
    /// Nothing: the box of such a child is empty, so that no ray visits it.
    pub const NONE: Self = Self(u32::MAX);
    /// The root, which is the first node.
    pub const ROOT: Self = Self(0);

    /// The node with this number.
    pub fn node(number: usize) -> Self {
        Self(number as u32)
    }

    /// The leaf with this number.
    pub fn leaf(number: usize) -> Self {
        Self(number as u32 | LEAF)
    }

    /// Its bits, which an entry of a stack holds.
    #[inline(always)]
    pub fn bits(self) -> u32 {
        self.0
    }

    /// The child of these bits.
    #[inline(always)]
    pub fn of_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// Whether it is a leaf.
    #[inline(always)]
    pub fn is_leaf(self) -> bool {
        self.0 & LEAF != 0
    }

    /// The number of the node or of the leaf.
    #[inline(always)]
    pub fn number(self) -> usize {
        (self.0 & !LEAF) as usize
    }

    /// What it is.
    #[inline(always)]
    pub fn kind(self) -> ChildKind {
        if self.is_leaf() { ChildKind::Leaf(self.number()) } else { ChildKind::Node(self.number()) }
    }
}

// ANCHOR: wide_node
/// A node with eight children: a structure of arrays, so that one ray is tested against all eight boxes at once.
///
/// It fills four cache lines.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct WideNode {
    /// The planes of the children's boxes: `planes[0]` are the lower ones and `planes[1]` the upper ones, by axis, then
    /// by child.
    pub planes: [[[f32; WIDTH]; 3]; 2],
    /// The children; the first ones are there, the others are [`Child::NONE`].
    pub child: [Child; WIDTH],
}
// ANCHOR_END: wide_node

impl WideNode {
    /// A node without children.
    pub fn empty() -> Self {
        let none = BoundingBox::default();
        let planes = [none.low.each(|low| [low; WIDTH]), none.high.each(|high| [high; WIDTH])];
        Self { planes, child: [Child::NONE; WIDTH] }
    }

    /// The planes by which a ray enters the slabs of all children, and those by which it leaves them, by axis; `first`
    /// says for each axis whether it enters by the lower ones, 0, or by the upper ones, 1.
    #[inline(always)]
    pub fn enter_and_leave(&self, first: [u32; 3]) -> [[&[f32; WIDTH]; 3]; 2] {
        let (planes, [x, y, z]) = (&self.planes, by_axis(|axis| first[axis] as usize & 1));
        [[&planes[x][0], &planes[y][1], &planes[z][2]], [&planes[1 - x][0], &planes[1 - y][1], &planes[1 - z][2]]]
    }

    /// The number of its children.
    pub fn children(&self) -> usize {
        self.child.iter().filter(|&&child| child != Child::NONE).count()
    }

    /// Sets a child and its box.
    pub fn set(&mut self, place: usize, child: Child, around: &BoundingBox) {
        for axis in 0..3 {
            self.planes[0][axis][place] = around.low[axis];
            self.planes[1][axis][place] = around.high[axis];
        }
        self.child[place] = child;
    }
}
