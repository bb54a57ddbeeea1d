//! Many rays through a hierarchy at once: node by node, each with a list of the rays that enter it.

use super::slab_test::BoxRay;
use super::wide_node::{ChildKind, WIDTH, WideNode};
use super::{BoundingBox, Bvh};
use multiversion::multiversion;

/// The most rays of a stream.
pub const STREAM: usize = 1024;

/// What is done in a leaf with the rays that enter its box, which are numbered within their stream.
///
/// It is asked once for all rays of a leaf, so that the traversal is compiled once and not for each kind of shape.
pub trait StreamLeaves {
    /// Writes the smallest t of every ray of the stream; negative if there is nothing to find.
    fn begin(&self, t: &mut [f64]);

    /// Looks into a leaf with these rays, and writes the smallest t of each so far; negative if there is nothing more to
    /// find.
    fn test(&mut self, leaf: usize, rays: &[u16], t: &mut [f64; STREAM]);
}

/// A node that is being visited, and the rays that entered it.
struct Level {
    node: usize,
    rays: [u16; STREAM],
    count: usize,
    /// Where each of these rays enters the box of each child; infinite where it does not.
    from: [[f32; WIDTH]; STREAM],
    /// The places in `rays` of those that enter each child.
    entering: [[u16; STREAM]; WIDTH],
    entered: [u32; WIDTH],
    /// The children that any ray enters, the nearest first, and the next of them.
    order: [usize; WIDTH],
    children: usize,
    next: usize,
}

impl Level {
    const EMPTY: Self = Self {
        node: 0,
        rays: [0; STREAM],
        count: 0,
        from: [[0.0; WIDTH]; STREAM],
        entering: [[0; STREAM]; WIDTH],
        entered: [0; WIDTH],
        order: [0; WIDTH],
        children: 0,
        next: 0,
    };

    // ANCHOR: stream_open
    /// Tests its rays against the eight boxes of its node, and lists those that enter each.
    ///
    /// Which boxes a ray enters is as hard to foretell as a coin, so there is no branch: its place is written to all
    /// eight lists, and only those that it belongs to grow.
    #[inline(always)]
    fn open(&mut self, nodes: &[WideNode], rays: &[BoxRay; STREAM], limit: &[f32; STREAM]) {
        let node = &nodes[self.node];
        let (mut entered, mut sum) = ([0_u32; WIDTH], [0.0_f32; WIDTH]);
        for place in 0..self.count.min(STREAM) {
            let (ray, from) = (usize::from(self.rays[place]) % STREAM, &mut self.from[place]);
            rays[ray].entries(node, limit[ray], from);
            for child in 0..WIDTH {
                self.entering[child][entered[child] as usize % STREAM] = place as u16;
                entered[child] += u32::from(from[child] < f32::INFINITY);
            }
            for child in 0..WIDTH {
                sum[child] += if from[child] < f32::INFINITY { from[child] } else { 0.0 };
            }
        }
        (self.entered, self.next) = (entered, 0);
        self.sort_children(&sum);
    }
    // ANCHOR_END: stream_open

    /// Puts the children in order by where their rays enter them on average.
    ///
    /// It is a matter of time only: what is far away from a ray is left out once something closer is found.
    #[inline(always)]
    fn sort_children(&mut self, sum: &[f32; WIDTH]) {
        self.children = 0;
        for child in (0..WIDTH).filter(|&child| self.entered[child] > 0) {
            let mean = |child: usize| sum[child] / self.entered[child] as f32;
            let mut place = self.children;
            while place > 0 && mean(self.order[place - 1]) > mean(child) {
                self.order[place] = self.order[place - 1];
                place -= 1;
            }
            self.order[place] = child;
            self.children += 1;
        }
    }

    /// The child that is visited next, if there is one.
    #[inline(always)]
    fn next_child(&mut self) -> Option<usize> {
        let child = self.order[..self.children].get(self.next).copied();
        self.next += 1;
        child
    }

    /// Hands the rays that enter a child on to `below`, but for those that have found something closer since.
    #[inline(always)]
    fn hand_on(&self, child: usize, limit: &[f32; STREAM], below: &mut Self) {
        below.count = 0;
        for &place in &self.entering[child][..self.entered[child] as usize] {
            let place = usize::from(place) % STREAM;
            let ray = self.rays[place];
            below.rays[below.count % STREAM] = ray;
            below.count += usize::from(self.from[place][child] <= limit[usize::from(ray) % STREAM]);
        }
    }
}

/// Up to [`STREAM`] rays on their way through a hierarchy, and the room that they need there, which is kept.
///
/// What one ray alone waits for, the test of a box before the next can be chosen and a node from memory, is worked on
/// here for many rays in a row, however different their directions (Tsakok, *Faster Incoherent Rays: Multi-BVH Ray Stream
/// Tracing*, 2009).
#[derive(Default)]
pub struct RayStream {
    /// Room for [`STREAM`] rays, once there is any.
    rays: Vec<BoxRay>,
    /// The smallest t of each ray so far; negative if there is nothing more to find.
    t: Vec<f64>,
    /// The same as the boxes see it.
    limit: Vec<f32>,
    count: usize,
    levels: Vec<Box<Level>>,
}

impl RayStream {
    /// Begins a stream without rays.
    #[inline(always)]
    pub fn clear(&mut self) {
        self.count = 0;
        self.rays.resize(STREAM, BoxRay::default());
        self.t.resize(STREAM, 0.0);
        self.limit.resize(STREAM, 0.0);
    }

    /// Adds `count` of `N` rays, which are given component by component, for a hierarchy with this box; `N` divides
    /// [`STREAM`], and only the last ones that are added may be fewer.
    #[inline(always)]
    pub fn add<const N: usize>(&mut self, rays: [&[[f64; N]; 3]; 2], count: usize, around: &BoundingBox) {
        BoxRay::fill(rays, around, &mut self.rays[self.count..self.count + N]);
        self.count += count;
    }

    /// Visits the leaves whose boxes its rays enter, until none can hold anything closer for any of them.
    pub fn traverse(&mut self, bvh: &Bvh, leaves: &mut dyn StreamLeaves) {
        let Self { rays, t, limit, count, levels } = self;
        if let (Some(rays), Some(t), Some(limit)) =
            (rays.first_chunk::<STREAM>(), t.first_chunk_mut::<STREAM>(), limit.first_chunk_mut::<STREAM>())
            && !bvh.nodes.is_empty()
        {
            leaves.begin(&mut t[..*count]);
            traverse_levels(bvh, (rays, t, limit), *count, levels, leaves);
        }
    }
}

/// [`RayStream::traverse`]; the smallest t of each ray is there as it is and as the boxes see it.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn traverse_levels(
    bvh: &Bvh,
    (rays, t, limit): (&[BoxRay; STREAM], &mut [f64; STREAM], &mut [f32; STREAM]),
    count: usize,
    levels: &mut Vec<Box<Level>>,
    leaves: &mut dyn StreamLeaves,
) {
    let root = level_at(levels, 0);
    (root.node, root.count) = (0, count);
    for ray in 0..count {
        root.rays[ray] = ray as u16;
        limit[ray] = rays[ray].limit_so_far(t[ray]);
    }
    root.open(&bvh.nodes, rays, limit);
    let mut depth = 0;
    loop {
        level_at(levels, depth + 1);
        let [at, below] = &mut levels[depth..depth + 2] else { return };
        let Some(child) = at.next_child() else {
            if depth == 0 {
                return;
            }
            depth -= 1;
            continue;
        };
        at.hand_on(child, limit, below);
        let entering = &below.rays[..below.count];
        match bvh.nodes[at.node].child[child].kind() {
            _ if entering.is_empty() => {}
            ChildKind::Leaf(leaf) => {
                leaves.test(leaf, entering, t);
                for ray in entering.iter().map(|&ray| usize::from(ray)) {
                    limit[ray] = rays[ray].limit_so_far(t[ray]);
                }
            }
            ChildKind::Node(number) => {
                below.node = number;
                below.open(&bvh.nodes, rays, limit);
                depth += 1;
            }
        }
    }
}

/// A level, for which room is made when a node is first that deep.
#[inline(always)]
fn level_at(levels: &mut Vec<Box<Level>>, depth: usize) -> &mut Level {
    if levels.len() <= depth {
        add_level(levels);
    }
    &mut levels[depth]
}

#[cold]
#[inline(never)]
fn add_level(levels: &mut Vec<Box<Level>>) {
    levels.push(Box::new(Level::EMPTY));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bvh::{LeafTest, Stack, Traversal, by_axis, tests::random_boxes};
    use crate::measure::draws::Draws;
    use glam::DVec3;

    /// The leaves that each ray looks into; what it finds in leaf k of those is at `t` less k.
    struct Visits {
        of: Vec<Vec<usize>>,
        t: f64,
    }

    impl Visits {
        fn t_of(&self, ray: usize) -> f64 {
            self.t - self.of[ray].len() as f64
        }
    }

    impl StreamLeaves for Visits {
        fn begin(&self, t: &mut [f64]) {
            t.iter_mut().enumerate().for_each(|(ray, t)| *t = self.t_of(ray));
        }

        fn test(&mut self, leaf: usize, rays: &[u16], t: &mut [f64; STREAM]) {
            for ray in rays.iter().map(|&ray| usize::from(ray)) {
                self.of[ray].push(leaf);
                t[ray] = self.t_of(ray);
            }
        }
    }

    /// The same of one ray alone.
    struct Alone(Vec<usize>);

    impl LeafTest for Alone {
        fn test(&mut self, leaf: usize) -> f64 {
            self.0.push(leaf);
            f64::INFINITY
        }
    }

    fn boxes_and_rays() -> (Bvh, Vec<[DVec3; 2]>) {
        let mut draws = Draws::new(4711, 0);
        let boxes = random_boxes(&mut draws, 700, 0.1);
        let mut rays: Vec<[DVec3; 2]> = (0..STREAM - 4)
            .map(|_| {
                let origin = draws.unit_vector() * draws.power_of_ten(-1.0, 3.0);
                let target = draws.unit_vector() * draws.unit();
                [origin, (target - origin) * draws.power_of_ten(-20.0, 20.0)]
            })
            .collect();
        // Rays that are none hit nothing, and must not keep the others from it.
        rays.push([DVec3::ZERO, DVec3::NAN]);
        rays.push([DVec3::NAN, DVec3::X]);
        rays.insert(500, [DVec3::ZERO, DVec3::INFINITY]);
        rays.insert(3, [DVec3::INFINITY, DVec3::X]);
        (Bvh::build::<4>(&boxes), rays)
    }

    fn visits(bvh: &Bvh, rays: &[[DVec3; 2]], t: f64) -> Vec<Vec<usize>> {
        let mut stream = RayStream::default();
        stream.clear();
        for some in rays.chunks(8) {
            let part = |which: usize| {
                by_axis(|axis| std::array::from_fn::<_, 8, _>(|i| some.get(i).map_or(1.0, |ray| ray[which][axis])))
            };
            stream.add([&part(0), &part(1)], some.len(), &bvh.around);
        }
        let mut leaves = Visits { of: vec![Vec::new(); rays.len()], t };
        stream.traverse(bvh, &mut leaves);
        leaves.of
    }

    #[test]
    fn rays_that_hit_nothing_look_into_the_same_leaves_as_alone() {
        let (bvh, rays) = boxes_and_rays();
        let mut visited = visits(&bvh, &rays, f64::INFINITY);
        let mut looked_into = 0;
        for (ray, leaves) in rays.iter().zip(&mut visited) {
            let mut alone = Alone(Vec::new());
            if let Some(mut traversal) = Traversal::new(&bvh, *ray, f64::INFINITY) {
                let mut stack = Stack::default();
                while traversal.step(false, &bvh, &mut stack, &mut alone) {}
            }
            leaves.sort_unstable();
            alone.0.sort_unstable();
            assert_eq!(*leaves, alone.0, "{ray:?}");
            looked_into += leaves.len();
        }
        assert!(looked_into > 2 * rays.len(), "{looked_into}");
    }

    /// After the first leaf the smallest t is negative, which says that there is nothing more to find.
    #[test]
    fn rays_that_have_all_that_they_want_look_no_further() {
        let (bvh, rays) = boxes_and_rays();
        let all = visits(&bvh, &rays, f64::INFINITY);
        let first = visits(&bvh, &rays, 0.5);
        let none = visits(&bvh, &rays, -1.0);
        assert!(first.iter().all(|leaves| leaves.len() <= 1), "one leaf at most");
        assert!(none.iter().all(Vec::is_empty), "none");
        assert!(all.iter().map(Vec::len).max() > Some(4), "there are more");
    }
}
