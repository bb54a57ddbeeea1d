//! Rays through the hierarchy of a mesh in lockstep: all of them take a step before any takes the next.
//!
//! One ray alone waits: for the node that it looks at next, and for the result of its comparisons before the processor
//! knows which that is.
//! Where all rays first compare their boxes, and then all that are in leaves their triangles, no comparison waits for
//! another; and those that go on in the same way do so in one loop, without a branch that nobody foresees.
//!
//! Each ray visits what it would visit alone, so its hit is the same to the last bit.

use super::mesh::PlacedMesh;
use super::mesh_traversal::{MeshHierarchy, slack_of};
use super::ray_block::{ClosestHit, ClosestHits, RaySlices};
use super::triangle_edges::MeshRay;
use crate::bvh::{BoxRay, Bvh, Child, Stack, WIDTH, by_axis, take_first};
use glam::DVec3;
use std::ops::Range;

/// The rays that are under way at once, a power of two.
const ABREAST: usize = 32;
/// How many rays are set up at once.
const AT_ONCE: usize = 8;
/// The entries that each ray's stack has room for; a ray that needs more goes on alone.
const ROOM: usize = 64;

/// A ray on its way.
#[derive(Clone, Copy)]
struct Ray {
    of_boxes: BoxRay,
    of_triangles: MeshRay,
    closest: ClosestHit,
    /// The smallest t so far as the boxes see it.
    limit: f32,
    /// The entries on its stack.
    height: u32,
    row: u32,
}

/// Places of rays, as a list without a branch: what is put in and not counted is written over.
#[derive(Clone, Copy)]
struct Places {
    of: [u32; ABREAST],
    count: usize,
}

impl Places {
    const NONE: Self = Self { of: [0; ABREAST], count: 0 };

    #[inline(always)]
    fn put_if(&mut self, place: usize, is_in: bool) {
        self.of[self.count % ABREAST] = place as u32;
        self.count += usize::from(is_in);
    }

    #[inline(always)]
    fn count(&self) -> usize {
        self.count.min(ABREAST)
    }

    #[inline(always)]
    fn at(&self, index: usize) -> usize {
        self.of[index] as usize % ABREAST
    }
}

/// The rays that are under way through one mesh, and what they need; kept from mesh to mesh.
pub struct Lockstep {
    rays: [Ray; ABREAST],
    stacks: [[u64; ROOM]; ABREAST],
    /// The node or leaf that each looks at next.
    next: [Child; ABREAST],
    /// Where each enters the children of its node, and which of them, as a byte each.
    entry: [[f32; WIDTH]; ABREAST],
    entered: [u64; ABREAST],
    at_nodes: Places,
    at_leaves: Places,
    /// Those that have nothing left to look at.
    idle: Places,
}

impl Default for Lockstep {
    fn default() -> Self {
        let mut idle = Places { count: ABREAST, ..Places::NONE };
        for (place, of) in idle.of.iter_mut().enumerate() {
            *of = place as u32;
        }
        let ray = Ray {
            of_boxes: BoxRay::default(),
            of_triangles: MeshRay::default(),
            closest: ClosestHit::NONE,
            limit: -1.0,
            height: 0,
            row: 0,
        };
        Self {
            rays: [ray; ABREAST],
            stacks: [[0; ROOM]; ABREAST],
            next: [Child::NONE; ABREAST],
            entry: [[0.0; WIDTH]; ABREAST],
            entered: [0; ABREAST],
            at_nodes: Places::NONE,
            at_leaves: Places::NONE,
            idle,
        }
    }
}

impl Lockstep {
    /// Intersects the rays of these rows with a mesh and keeps the closest hits; `alone` is for a ray that needs more of
    /// a stack than it has here.
    #[inline(always)]
    pub fn keep_closest<const ANY: bool>(
        &mut self,
        (mesh, number): (&PlacedMesh, u32),
        mut rows: Range<usize>,
        rays: RaySlices<'_>,
        hits: &mut ClosestHits<'_>,
        alone: &mut Stack,
    ) {
        let hierarchy = &*mesh.hierarchy;
        loop {
            while !rows.is_empty() && self.idle.count >= AT_ONCE {
                self.begin::<ANY>(mesh, &mut rows, rays, hits);
            }
            if self.at_nodes.count + self.at_leaves.count == 0 {
                return;
            }
            let (nodes, leaves) = (self.at_nodes, self.at_leaves);
            (self.at_nodes, self.at_leaves) = (Places::NONE, Places::NONE);
            let [mut back, one, two, more] = self.compare_boxes(&hierarchy.bvh, &nodes);
            self.enter_one(&hierarchy.bvh, &one);
            self.enter_two(&hierarchy.bvh, &two);
            self.enter_more::<ANY>(&hierarchy.bvh, &more);
            self.look_into_leaves::<ANY>((hierarchy, number), &leaves, &mut back, hits);
            for index in 0..back.count() {
                self.go_back(back.at(index), hits);
            }
            for places in [two, more] {
                for index in 0..places.count() {
                    if self.rays[places.at(index)].height as usize > ROOM - WIDTH {
                        self.go_alone::<ANY>((hierarchy, number), places.at(index), alone);
                    }
                }
            }
        }
    }

    /// Sets up the next rays, up to eight, for which there must be room; how they see boxes is computed of all at once.
    #[inline(always)]
    fn begin<const ANY: bool>(
        &mut self,
        mesh: &PlacedMesh,
        rows: &mut Range<usize>,
        rays: RaySlices<'_>,
        hits: &ClosestHits<'_>,
    ) {
        let (mut of_row, mut start, mut count) = ([0; AT_ONCE], [0.0; AT_ONCE], 0);
        let (mut origin, mut direction) = ([[0.0; AT_ONCE]; 3], [[1.0; AT_ONCE]; 3]);
        while count < AT_ONCE && rows.start < rows.end {
            let row = rows.start;
            rows.start += 1;
            if ANY && hits.get(row).is_enough() {
                continue;
            }
            let ([o, d], t) = mesh.own_ray(rays.ray(row));
            for axis in 0..3 {
                (origin[axis][count], direction[axis][count]) = (o[axis], d[axis]);
            }
            (of_row[count], start[count]) = (row, t);
            count += 1;
        }
        let mut of_boxes = [BoxRay::default(); AT_ONCE];
        BoxRay::fill([&origin, &direction], &mesh.hierarchy.bvh.around, &mut of_boxes);
        for ray in 0..count {
            let vector = |of: &[[f64; AT_ONCE]; 3]| DVec3::from(by_axis(|axis| of[axis][ray]));
            let (of_boxes, closest) = (of_boxes[ray], hits.get(of_row[ray]));
            let of_triangles = MeshRay::new(vector(&origin), vector(&direction), start[ray], mesh.hierarchy.size);
            let limit = of_boxes.limit(closest.t + slack_of(start[ray]));
            self.idle.count -= 1;
            let place = self.idle.at(self.idle.count);
            self.rays[place] = Ray { of_boxes, of_triangles, closest, limit, height: 0, row: of_row[ray] as u32 };
            self.go_to(place, Child::ROOT);
        }
    }

    /// Has a ray look at a node or a leaf next.
    #[inline(always)]
    fn go_to(&mut self, place: usize, next: Child) {
        self.next[place] = next;
        self.at_nodes.put_if(place, !next.is_leaf());
        self.at_leaves.put_if(place, next.is_leaf());
    }

    // ANCHOR: compare_boxes
    /// Compares the rays that are at nodes with the boxes of their children, and sorts them by how many they enter: none,
    /// one, two, or more.
    #[inline(always)]
    fn compare_boxes(&mut self, bvh: &Bvh, at_nodes: &Places) -> [Places; 4] {
        for index in 0..at_nodes.count() {
            let place = at_nodes.at(index);
            let ray = &self.rays[place];
            let node = &bvh.nodes[self.next[place].number()];
            self.entered[place] = ray.of_boxes.enters(node, ray.limit, &mut self.entry[place]);
        }
        let mut by_count = [Places::NONE; 4];
        for index in 0..at_nodes.count() {
            let place = at_nodes.at(index);
            let children = self.entered[place].count_ones() as usize;
            by_count[children.min(3)].put_if(place, true);
        }
        by_count
    }
    // ANCHOR_END: compare_boxes

    /// Goes on to the only child that rays enter.
    #[inline(always)]
    fn enter_one(&mut self, bvh: &Bvh, one: &Places) {
        for index in 0..one.count() {
            let place = one.at(index);
            let child = take_first(&mut self.entered[place]);
            self.go_to(place, bvh.nodes[self.next[place].number()].child[child]);
        }
    }

    /// Goes on to the nearer of two children, and puts the other off.
    #[inline(always)]
    fn enter_two(&mut self, bvh: &Bvh, two: &Places) {
        for index in 0..two.count() {
            let place = two.at(index);
            let (a, b) = (self.next_entry(bvh, place), self.next_entry(bvh, place));
            let (nearest, farther) = if a < b { (a, b) } else { (b, a) };
            self.stacks[place][self.rays[place].height as usize % ROOM] = farther;
            self.rays[place].height += 1;
            self.go_to(place, Child::of_bits(nearest as u32));
        }
    }

    /// Goes on to the nearest of several children, and puts the others off, the nearest on top.
    #[inline(always)]
    fn enter_more<const ANY: bool>(&mut self, bvh: &Bvh, more: &Places) {
        for index in 0..more.count() {
            let place = more.at(index);
            let mut nearest = self.next_entry(bvh, place);
            let base = self.rays[place].height as usize;
            let mut height = base;
            while self.entered[place] != 0 {
                let (entry, farther);
                entry = self.next_entry(bvh, place);
                (nearest, farther) = if entry < nearest { (entry, nearest) } else { (nearest, entry) };
                let (stack, mut at) = (&mut self.stacks[place], height);
                while !ANY && at > base && stack[(at - 1) % ROOM] < farther {
                    stack[at % ROOM] = stack[(at - 1) % ROOM];
                    at -= 1;
                }
                stack[at % ROOM] = farther;
                height += 1;
            }
            self.rays[place].height = height as u32;
            self.go_to(place, Child::of_bits(nearest as u32));
        }
    }

    /// The next child that a ray enters, as an entry of its stack.
    #[inline(always)]
    fn next_entry(&mut self, bvh: &Bvh, place: usize) -> u64 {
        let child = take_first(&mut self.entered[place]);
        Stack::entry(self.entry[place][child], bvh.nodes[self.next[place].number()].child[child].bits())
    }

    /// Looks into the leaves that rays are at; lists those that have to go back in `back`.
    #[inline(always)]
    fn look_into_leaves<const ANY: bool>(
        &mut self,
        (hierarchy, number): (&MeshHierarchy, u32),
        at_leaves: &Places,
        back: &mut Places,
        hits: &mut ClosestHits<'_>,
    ) {
        let mut may_hit = Places::NONE;
        for index in 0..at_leaves.count() {
            let place = at_leaves.at(index);
            let block = &hierarchy.blocks[self.next[place].number()];
            self.entered[place] = block.may_hit(&self.rays[place].of_triangles);
            may_hit.put_if(place, self.entered[place] != 0);
            back.put_if(place, self.entered[place] == 0);
        }
        for index in 0..may_hit.count() {
            let place = may_hit.at(index);
            let block = &hierarchy.blocks[self.next[place].number()];
            let ray = &mut self.rays[place];
            let before = ray.closest.t;
            block.keep_closest_among(self.entered[place], &ray.of_triangles, number, &mut ray.closest);
            if ray.closest.t < before {
                if ANY {
                    self.end(place, hits);
                    continue;
                }
                ray.limit = ray.of_boxes.limit(ray.closest.t + slack_of(ray.of_triangles.start));
            }
            back.put_if(place, true);
        }
    }

    /// Has a ray look next at the nearest of what it has put off; ends it where nothing is left.
    #[inline(always)]
    fn go_back(&mut self, place: usize, hits: &mut ClosestHits<'_>) {
        let ray = &mut self.rays[place];
        while ray.height > 0 {
            ray.height -= 1;
            let (from, child) = Stack::parts(self.stacks[place][ray.height as usize % ROOM]);
            if from <= ray.limit {
                self.go_to(place, Child::of_bits(child));
                return;
            }
        }
        self.end(place, hits);
    }

    /// Finds the rest of a ray's way with a stack that has room for it: from the root, which costs what it has seen, and
    /// happens where dozens of boxes lie within one another.
    #[cold]
    #[inline(never)]
    fn go_alone<const ANY: bool>(
        &mut self,
        (hierarchy, number): (&MeshHierarchy, u32),
        place: usize,
        stack: &mut Stack,
    ) {
        let Ray { of_triangles, closest, .. } = self.rays[place];
        let own = ([of_triangles.origin, of_triangles.direction], of_triangles.start);
        let closest = hierarchy.keep_closest_until::<ANY>(own, number, closest, stack);
        // It enters nothing any more, and so ends with its next step.
        self.rays[place] = Ray { closest, limit: -1.0, height: 0, ..self.rays[place] };
    }

    #[inline(always)]
    fn end(&mut self, place: usize, hits: &mut ClosestHits<'_>) {
        hits.set(self.rays[place].row as usize, self.rays[place].closest);
        self.idle.put_if(place, true);
    }
}
