//! One ray through a hierarchy: node by node and leaf by leaf, the nearest first.

use super::slab_test::{BoxRay, take_first};
use super::wide_node::{Child, ChildKind, WIDTH};
use super::{Bvh, MAX_LEVELS};
use glam::DVec3;

/// The entries that the stack has room for: a power of two that is more than seven for each level, and eight.
pub(super) const ROOM: usize = 512;
const _: () = assert!((WIDTH - 1) * MAX_LEVELS + WIDTH < ROOM);

/// What a traversal has still to visit, made once for many rays.
///
/// An entry is a number whose upper half holds the bits of where the ray enters the box, and whose lower half says what
/// is in it: the bits of positive numbers of f32 have the order of the numbers, so entries are sorted as they are.
pub struct Stack([u64; ROOM]);

impl Default for Stack {
    fn default() -> Self {
        Self([0; ROOM])
    }
}

impl Stack {
    /// An entry.
    #[inline(always)]
    pub fn entry(from: f32, what: u32) -> u64 {
        u64::from(from.to_bits()) << 32 | u64::from(what)
    }

    /// Where the ray enters the box of an entry, and what is in it.
    #[inline(always)]
    pub fn parts(entry: u64) -> (f32, u32) {
        (f32::from_bits((entry >> 32) as u32), entry as u32)
    }

    /// Puts an entry on top of `height` others.
    #[inline(always)]
    pub fn put(&mut self, height: usize, entry: u64) {
        self.0[height % ROOM] = entry;
    }

    /// Sorts an entry in among those from `base` to `height`, the nearest on top.
    #[inline(always)]
    pub fn sort_in(&mut self, base: usize, height: usize, entry: u64) {
        let mut place = height;
        while place > base && self.0[(place - 1) % ROOM] < entry {
            self.0[place % ROOM] = self.0[(place - 1) % ROOM];
            place -= 1;
        }
        self.0[place % ROOM] = entry;
    }

    /// The entry at this height.
    #[inline(always)]
    pub fn at(&self, height: usize) -> u64 {
        self.0[height % ROOM]
    }
}

/// What is done in a leaf.
///
/// It is a trait and no closure, because only a method can be marked to be inlined, and so be compiled for the same
/// instructions as the traversal around it.
pub trait LeafTest {
    /// Looks into the leaf with this number, and gives the smallest t so far.
    fn test(&mut self, leaf: usize) -> f64;
}

/// A ray on its path through a hierarchy: where it is, and how much of its stack is filled.
///
/// With `any`, the first leaf that finds anything ends it; otherwise it goes on until nothing can be closer, and what
/// is at an equal distance is visited too, so that ties are decided by numbers and not by the hierarchy.
pub struct Traversal {
    ray: BoxRay,
    /// The smallest t so far, and the same as the boxes see it.
    t: f64,
    limit: f32,
    height: usize,
    at: Child,
}

impl Traversal {
    /// A ray at the root; none if it is not finite, since it hits nothing then.
    #[inline(always)]
    pub fn new(bvh: &Bvh, [origin, direction]: [DVec3; 2], t_max: f64) -> Option<Self> {
        if bvh.nodes.is_empty() || !(origin.is_finite() && direction.is_finite()) {
            return None;
        }
        let ray = BoxRay::new(origin, direction, &bvh.around);
        Some(Self { ray, t: t_max, limit: ray.limit(t_max), height: 0, at: Child::ROOT })
    }

    /// What it visits next.
    pub(super) fn at(&self) -> Child {
        self.at
    }

    /// The entries on its stack.
    pub(super) fn height(&self) -> usize {
        self.height
    }

    // ANCHOR: step
    /// Visits one node or one leaf, and says whether there is more to visit.
    #[inline(always)]
    pub fn step(&mut self, any: bool, bvh: &Bvh, stack: &mut Stack, leaves: &mut impl LeafTest) -> bool {
        match self.at.kind() {
            ChildKind::Leaf(number) => {
                let t = leaves.test(number);
                if t < self.t {
                    if any {
                        return false;
                    }
                    (self.t, self.limit) = (t, self.ray.limit(t));
                }
            }
            ChildKind::Node(number) => {
                let node = &bvh.nodes[number];
                let mut from = [0.0; WIDTH];
                let mut mask = self.ray.enters(node, self.limit, &mut from);
                if mask != 0 {
                    let mut next = || {
                        let child = take_first(&mut mask);
                        (Stack::entry(from[child], node.child[child].bits()), mask != 0)
                    };
                    // The nearest child is visited next, and the others are put off.
                    let (mut nearest, mut more) = next();
                    let base = self.height;
                    let mut height = base;
                    while more {
                        let (entry, farther);
                        (entry, more) = next();
                        (nearest, farther) = if entry < nearest { (entry, nearest) } else { (nearest, entry) };
                        if any {
                            stack.put(height, farther)
                        } else {
                            stack.sort_in(base, height, farther)
                        }
                        height += 1;
                    }
                    self.height = height;
                    self.at = Child::of_bits(nearest as u32);
                    return true;
                }
            }
        }
        while self.height > 0 {
            self.height -= 1;
            let (from, child) = Stack::parts(stack.at(self.height));
            if from <= self.limit {
                self.at = Child::of_bits(child);
                return true;
            }
        }
        false
    }
    // ANCHOR_END: step
}
