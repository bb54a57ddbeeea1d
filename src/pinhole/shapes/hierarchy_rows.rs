use super::ray_block::{ClosestHit, ClosestHits, RaySlices, nearness};
use super::shape::Shape;
use crate::bvh::{BoundingBox, Bvh, LeafTest, Stack, TestCounts, Traversal, traverse, traverse_counted};
use glam::DVec3;
use multiversion::multiversion;

/// The most shapes of a leaf.
const LEAF: usize = 4;

/// The hierarchy over shapes of one kind; none where one of them is infinite.
pub fn hierarchy_of<S: Shape>(shapes: &[S]) -> Option<Bvh> {
    let around = |shape: &S| shape.bounds().map(|bounds| BoundingBox::around(bounds.min, bounds.max));
    let boxes: Option<Vec<BoundingBox>> = shapes.iter().map(around).collect();
    Some(Bvh::build::<LEAF>(&boxes?))
}

/// A ray in the leaves of a table of shapes, and its closest hit so far.
struct ShapeLeaves<'a, S> {
    shapes: &'a [S],
    numbers: &'a [u32],
    bvh: &'a Bvh,
    ray: [DVec3; 2],
    /// 1 / R·R.
    inverse: f64,
    closest: ClosestHit,
    /// For shapes that have a hierarchy of their own.
    inner: &'a mut Stack,
}

impl<S: Shape> LeafTest for ShapeLeaves<'_, S> {
    #[inline(always)]
    fn test(&mut self, leaf: usize) -> f64 {
        for &place in self.bvh.primitives(leaf) {
            let (shape, number) = (&self.shapes[place as usize], self.numbers[place as usize]);
            if shape.culling_sphere().is_some_and(|sphere| misses(self.ray, self.inverse, sphere)) {
                continue;
            }
            self.closest = shape.keep_closest_of_ray(self.ray, number, self.closest, self.inner);
        }
        self.closest.t
    }
}

/// Whether a ray's line certainly misses a sphere, which takes no division and no root.
#[inline(always)]
fn misses([origin, direction]: [DVec3; 2], inverse: f64, (centre, radius): (DVec3, f64)) -> bool {
    nearness(centre - origin, direction, inverse, radius) < 0.0
}

/// Intersects one ray at a time with the shapes whose boxes it hits, and keeps the closest hits.
///
/// The result is to the last bit that of testing all shapes: a hierarchy only says which may be left out. The stacks, one
/// for this hierarchy and one for those of the shapes, are room that is kept from tile to tile.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn keep_closest_of<S: Shape>(
    (shapes, numbers, bvh): (&[S], &[u32], &Bvh),
    rays: RaySlices<'_>,
    mut hits: ClosestHits<'_>,
    [stack, inner]: &mut [Stack; 2],
) {
    for row in 0..hits.t.len() {
        let (ray, closest) = (rays.ray(row), hits.get(row));
        if closest.is_enough() {
            continue;
        }
        let inverse = 1.0 / ray[1].dot(ray[1]);
        let mut leaves = ShapeLeaves { shapes, numbers, bvh, ray, inverse, closest, inner };
        // Constants, so that each of the two loops asks for nothing that only the other needs.
        match closest.any {
            true => traverse(true, bvh, ray, closest.t, stack, &mut leaves),
            false => traverse(false, bvh, ray, closest.t, stack, &mut leaves),
        }
        hits.set(row, leaves.closest);
    }
}

/// Intersects one ray with shapes, keeps the closest hit, and counts what it is tested against: where there is no
/// hierarchy, all of them.
pub fn keep_closest_counted<S: Shape>(
    (shapes, numbers, bvh): (&[S], &[u32], Option<&Bvh>),
    ray: [DVec3; 2],
    mut closest: ClosestHit,
    counts: &mut TestCounts,
) -> ClosestHit {
    let Some(bvh) = bvh else {
        for (shape, &number) in shapes.iter().zip(numbers) {
            closest = shape.keep_closest_counted(ray, number, closest, 0, counts);
        }
        return closest;
    };
    if let Some(traversal) = Traversal::new(bvh, ray, closest.t) {
        traverse_counted(bvh, traversal, 0, counts, |leaf, above, counts| {
            for &place in bvh.primitives(leaf) {
                let (shape, number) = (&shapes[place as usize], numbers[place as usize]);
                closest = shape.keep_closest_counted(ray, number, closest, above, counts);
            }
            closest.t
        });
    }
    closest
}
