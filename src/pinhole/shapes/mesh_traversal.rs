//! Rays through the hierarchy of a mesh, one by one or several in turns.

use super::mesh_hierarchy::MeshHierarchy;
use super::ray_block::{ClosestHit, ClosestHits};
use super::triangle_block::MeshRay;
use crate::bvh::{LeafTest, Stack, TestCounts, Traversal, traverse_counted};
use glam::DVec3;
use std::ops::Range;

/// The rays that take turns.
const TURNS: usize = 4;
/// A hierarchy of more bytes than this, which is about what caches hold, keeps rays waiting for memory so often that
/// turns pay.
const BEYOND_CACHES: usize = 16 << 20;

/// A stack for each of the rays that take turns.
pub type MeshStacks = [Stack; TURNS];

/// A ray in object space, and the t at which it starts there.
pub type OwnRay = ([DVec3; 2], f64);

/// A ray in the leaves of a mesh, and its closest hit so far.
struct MeshLeaves<'a> {
    hierarchy: &'a MeshHierarchy,
    ray: MeshRay,
    number: u32,
    closest: ClosestHit,
    /// What is added to a t to compare it with those of the ray in object space.
    slack: f64,
}

impl LeafTest for MeshLeaves<'_> {
    #[inline(always)]
    fn test(&mut self, leaf: usize) -> f64 {
        self.hierarchy.blocks[leaf].keep_closest(&self.ray, self.number, &mut self.closest);
        self.closest.t + self.slack
    }
}

/// A ray on its path through the hierarchy of a mesh.
struct MeshTraversal<'a> {
    leaves: MeshLeaves<'a>,
    traversal: Traversal,
}

impl<'a> MeshTraversal<'a> {
    /// A ray at the root; none if it is not finite, since it hits nothing then, and none if a hit is enough and there.
    #[inline(always)]
    fn new(hierarchy: &'a MeshHierarchy, (ray, start): OwnRay, number: u32, closest: ClosestHit) -> Option<Self> {
        if closest.is_enough() {
            return None;
        }
        // More than the rounding of the sum start + τ, so that ties are found.
        let slack = start * (1.0 / (1_u64 << 50) as f64) - start;
        let traversal = Traversal::new(&hierarchy.bvh, ray, closest.t + slack)?;
        let [origin, direction] = ray;
        let ray = MeshRay::new(origin, direction, start, hierarchy.size);
        Some(Self { leaves: MeshLeaves { hierarchy, ray, number, closest, slack }, traversal })
    }

    /// Visits one node or one leaf, and says whether there is more to visit.
    #[inline(always)]
    fn step<const ANY: bool>(&mut self, stack: &mut Stack) -> bool {
        self.traversal.step(ANY, &self.leaves.hierarchy.bvh, stack, &mut self.leaves)
    }
}

impl MeshHierarchy {
    /// Intersects a ray in object space and keeps the closest hit; `number` is that of the shape which the mesh belongs
    /// to.
    #[inline(always)]
    pub fn keep_closest(&self, ray: OwnRay, number: u32, closest: ClosestHit, stack: &mut Stack) -> ClosestHit {
        match closest.any {
            true => self.keep_closest_until::<true>(ray, number, closest, stack),
            false => self.keep_closest_until::<false>(ray, number, closest, stack),
        }
    }

    /// The same, and counts what the ray is tested against; `above` nodes of a hierarchy over meshes are above this one.
    pub fn keep_closest_counted(
        &self,
        ray: OwnRay,
        number: u32,
        closest: ClosestHit,
        above: u32,
        counts: &mut TestCounts,
    ) -> ClosestHit {
        let Some(MeshTraversal { mut leaves, traversal }) = MeshTraversal::new(self, ray, number, closest) else {
            return closest;
        };
        traverse_counted(&self.bvh, traversal, above, counts, |leaf, _, counts| {
            counts.primitives += self.bvh.primitives(leaf).len() as u32;
            leaves.test(leaf)
        });
        leaves.closest
    }

    #[inline(always)]
    fn keep_closest_until<const ANY: bool>(
        &self,
        ray: OwnRay,
        number: u32,
        closest: ClosestHit,
        stack: &mut Stack,
    ) -> ClosestHit {
        let Some(mut traversal) = MeshTraversal::new(self, ray, number, closest) else { return closest };
        while traversal.step::<ANY>(stack) {}
        traversal.leaves.closest
    }
}

/// Intersects the rays of these rows, which `own_ray` takes to object space, each on its own, and keeps the closest
/// hits.
///
/// Where the hierarchy is larger than the caches, several rays take turns: while one waits for a node or a leaf, the
/// processor goes on with another.
#[inline(always)]
pub fn keep_closest_apart<const ANY: bool>(
    hierarchy: &MeshHierarchy,
    number: u32,
    mut rows: Range<usize>,
    own_ray: impl Fn(usize) -> OwnRay,
    hits: &mut ClosestHits<'_>,
    stacks: &mut MeshStacks,
) {
    if hierarchy.bytes() <= BEYOND_CACHES || rows.len() < TURNS {
        for row in rows {
            let closest = hits.get(row);
            let closest = hierarchy.keep_closest_until::<ANY>(own_ray(row), number, closest, &mut stacks[0]);
            hits.set(row, closest);
        }
        return;
    }
    let mut next = |hits: &ClosestHits<'_>| {
        rows.find_map(|row| {
            let traversal = MeshTraversal::new(hierarchy, own_ray(row), number, hits.get(row))?;
            Some((row, traversal))
        })
    };
    let mut under_way: [_; TURNS] = std::array::from_fn(|_| next(hits));
    let mut count = under_way.iter().flatten().count();
    while count > 0 {
        for (turn, stack) in under_way.iter_mut().zip(&mut *stacks) {
            let Some((row, traversal)) = turn else { continue };
            if !traversal.step::<ANY>(stack) {
                hits.set(*row, traversal.leaves.closest);
                *turn = next(hits);
                count -= usize::from(turn.is_none());
            }
        }
    }
}
