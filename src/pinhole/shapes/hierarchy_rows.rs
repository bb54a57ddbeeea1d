use super::ray_block::{BlockHits, ClosestHit, ClosestHits, LANES, RayBlock, RaySlices, keep_closest_near, nearness};
use super::shape::Shape;
use crate::bvh::{BoundingBox, Bvh, RayStream, STREAM, Stack, StreamLeaves, TestCounts, Traversal, traverse_counted};
use glam::DVec3;
use multiversion::multiversion;

/// The most shapes of a leaf.
const LEAF: usize = 4;
/// Fewer rays than this are tested one by one: a block takes as long with one as with sixteen.
const FEW: usize = 4;

/// The hierarchy over shapes of one kind; none where one of them is infinite.
pub fn hierarchy_of<S: Shape>(shapes: &[S]) -> Option<Bvh> {
    let around = |shape: &S| shape.bounds().map(|bounds| BoundingBox::around(bounds.min, bounds.max));
    let boxes: Option<Vec<BoundingBox>> = shapes.iter().map(around).collect();
    Some(Bvh::build::<LEAF>(&boxes?))
}

/// The rays from `start` on in the leaves of a table of shapes, and their closest hits so far.
struct ShapeLeaves<'a, 'b, S> {
    shapes: &'a [S],
    numbers: &'a [u32],
    bvh: &'a Bvh,
    rays: RaySlices<'a>,
    start: usize,
    hits: &'a mut ClosestHits<'b>,
    /// For shapes that have a hierarchy of their own.
    inner: &'a mut Stack,
}

impl<S: Shape> ShapeLeaves<'_, '_, S> {
    /// The smallest t of a ray so far; negative if there is nothing more to find.
    #[inline(always)]
    fn t(&self, ray: usize) -> f64 {
        let row = self.start + ray;
        if self.hits.get(row).is_enough() { -1.0 } else { self.hits.t[row] }
    }
}

impl<S: Shape> StreamLeaves for ShapeLeaves<'_, '_, S> {
    fn begin(&self, t: &mut [f64]) {
        for (ray, t) in t.iter_mut().enumerate() {
            *t = self.t(ray);
        }
    }

    fn test(&mut self, leaf: usize, rays: &[u16], t: &mut [f64; STREAM]) {
        for some in rays.chunks(LANES) {
            let mut rows = [0; LANES];
            let rows = &mut rows[..some.len()];
            for (row, &ray) in rows.iter_mut().zip(some) {
                *row = (self.start + usize::from(ray)) as u32;
            }
            if S::IN_BLOCKS && some.len() >= FEW {
                self.test_together(leaf, rows);
            } else {
                test_alone(
                    (self.shapes, self.numbers),
                    self.bvh.primitives(leaf),
                    self.rays,
                    rows,
                    self.hits,
                    self.inner,
                );
            }
        }
        for ray in rays.iter().map(|&ray| usize::from(ray)) {
            t[ray] = self.t(ray);
        }
    }
}

impl<S: Shape> ShapeLeaves<'_, '_, S> {
    /// The rays of up to sixteen rows, for which one shape after another is tested.
    fn test_together(&mut self, leaf: usize, rows: &[u32]) {
        let block = RayBlock::of_rows(self.rays, rows);
        let inverse = block.inverses();
        let mut closest = BlockHits::of_rows(self.hits.t, self.hits.shape, rows);
        for &place in self.bvh.primitives(leaf) {
            let (shape, number) = (&self.shapes[place as usize], self.numbers[place as usize]);
            keep_closest_near(&block, &inverse, shape, number, &mut closest);
        }
        closest.write_rows(self.hits.t, self.hits.shape, rows);
    }
}

/// The rays of some rows, each alone, and the shapes at some places.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn test_alone<S: Shape>(
    (shapes, numbers): (&[S], &[u32]),
    places: &[u32],
    rays: RaySlices<'_>,
    rows: &[u32],
    hits: &mut ClosestHits<'_>,
    inner: &mut Stack,
) {
    for row in rows.iter().map(|&row| row as usize) {
        let ray = rays.ray(row);
        let (mut closest, inverse) = (hits.get(row), 1.0 / ray[1].dot(ray[1]));
        for &place in places {
            let (shape, number) = (&shapes[place as usize], numbers[place as usize]);
            if shape
                .culling_sphere()
                .is_some_and(|(centre, radius)| nearness(centre - ray[0], ray[1], inverse, radius) < 0.0)
            {
                continue;
            }
            closest = shape.keep_closest_of_ray(ray, number, closest, inner);
        }
        hits.set(row, closest);
    }
}

/// What a column of rays needs on its way through hierarchies, kept from tile to tile.
#[derive(Default)]
pub struct HierarchyRoom {
    stream: RayStream,
    /// For one ray in a shape that has a hierarchy of its own.
    inner: Stack,
}

/// Intersects a column of rays with the shapes whose boxes they enter, and keeps the closest hits.
///
/// The result is to the last bit that of testing all shapes: a hierarchy only says which may be left out.
pub fn keep_closest_of<S: Shape>(
    (shapes, numbers, bvh): (&[S], &[u32], &Bvh),
    rays: RaySlices<'_>,
    mut hits: ClosestHits<'_>,
    HierarchyRoom { stream, inner }: &mut HierarchyRoom,
) {
    let rows = hits.t.len();
    for start in (0..rows.div_ceil(STREAM)).map(|part| part * STREAM) {
        stream.clear();
        let end = rows.min(start + STREAM);
        add_rays(stream, rays, [start, end], &bvh.around);
        let mut leaves = ShapeLeaves { shapes, numbers, bvh, rays, start, hits: &mut hits, inner };
        stream.traverse(bvh, &mut leaves);
    }
}

/// Adds the rays of some rows to a stream, for a hierarchy with this box.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn add_rays(stream: &mut RayStream, rays: RaySlices<'_>, [start, end]: [usize; 2], around: &BoundingBox) {
    let mut first = start;
    while first < end {
        let last = end.min(first + LANES);
        let RayBlock { o, d } = RayBlock::of(rays, first, last);
        stream.add([&o, &d], last - first, around);
        first = last;
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
