//! Rays through the hierarchy of a mesh, alone and in packets.

use super::ray_block::{ClosestHit, ClosestHits, RaySlices};
use super::triangle::exact_triangle_t;
use super::triangle_edges::{
    BLOCK, MeshRay, ROUNDING, ROUNDING_F32, TriangleBlock, certain_t, edge_values, in_f64, longest_axis, may_be_hit,
    may_be_hit_in_f32,
};
use crate::bvh::{
    BoundingBox, BoxPacket, Bvh, ChildKind, LeafTest, PACKET, PerRay, ROW, ROWS, Stack, TestCounts, Traversal, WIDTH,
    take_first, traverse_counted,
};
use crate::each::Each;
use glam::{DMat3, DVec3};
use pinhole_models::TriangleMesh;
use rayon::prelude::*;
use std::sync::OnceLock;

/// The fewest triangles that are worth a task of their own.
const TASK: usize = 4096;
/// A mesh of more triangles than this is bounded by the corners of its bounding box.
const FEW: usize = 64;

/// A mesh as rays are intersected with it: its triangles in the leaves of a hierarchy, in object space.
///
/// All instances of the mesh share it.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshHierarchy {
    /// The hierarchy; a leaf's number is that of its block.
    pub bvh: Bvh,
    pub(super) blocks: Vec<TriangleBlock>,
    /// The largest |x| + |y| + |z| of a vertex.
    pub size: f64,
    closed: OnceLock<bool>,
}

impl MeshHierarchy {
    /// The hierarchy of a mesh.
    pub fn of(mesh: &TriangleMesh) -> Self {
        let around = |triangle: usize| {
            let mut around = BoundingBox::default();
            mesh.corners(triangle).into_iter().for_each(|at| around.enclose(&BoundingBox { low: at, high: at }));
            around
        };
        let triangles = (0..mesh.triangles.len()).into_par_iter().with_min_len(TASK);
        let boxes: Vec<BoundingBox> = triangles.map(around).collect();
        let bvh = Bvh::build::<BLOCK>(&boxes);
        let leaves = (0..bvh.leaves.len()).into_par_iter().with_min_len(TASK);
        let blocks = leaves.map(|leaf| TriangleBlock::of(mesh, bvh.primitives(leaf))).collect();
        let size_of = |position: &[f32; 3]| position.each(|part| f64::from(part.abs())).iter().sum();
        let size = mesh.positions.iter().map(size_of).fold(0.0, f64::max);
        Self { bvh, blocks, size, closed: OnceLock::new() }
    }

    /// The closest hit of a ray in object space among all triangles, without the hierarchy.
    pub fn closest_of_all(&self, [origin, direction]: [DVec3; 2], start: f64) -> ClosestHit {
        let (ray, mut closest) = (MeshRay::new(origin, direction, start, self.size), ClosestHit::NONE);
        self.blocks.iter().for_each(|block| block.keep_closest(&ray, 0, &mut closest));
        closest
    }

    /// Whether every edge is passed as often in one direction as in the other, as it is on a closed surface.
    ///
    /// Vertices at the same position are the same.
    pub fn is_closed(&self, mesh: &TriangleMesh) -> bool {
        *self.closed.get_or_init(|| edges_cancel(mesh))
    }

    /// The least and greatest coordinates of the placed mesh, without its position: those of all vertices, or of its
    /// bounding box's corners where there are many, since each instance asks.
    pub(super) fn placed_extent(&self, mesh: &TriangleMesh, world_from_object: DMat3) -> (DVec3, DVec3) {
        let extent = |points: &mut dyn Iterator<Item = DVec3>| {
            points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), at| {
                let at = world_from_object * at;
                (low.min(at), high.max(at))
            })
        };
        if mesh.triangles.len() > FEW {
            let sides = [self.bvh.around.low, self.bvh.around.high].each(|side| DVec3::from(side.each(f64::from)));
            let corner = |at: usize| DVec3::new(sides[at & 1].x, sides[at >> 1 & 1].y, sides[at >> 2].z);
            return extent(&mut (0..8).map(corner));
        }
        let vertices = mesh.triangles.iter().flatten();
        extent(&mut vertices.map(|&vertex| DVec3::from(mesh.positions[vertex as usize].each(f64::from))))
    }

    /// The memory of its arrays, in bytes.
    pub fn bytes(&self) -> usize {
        self.bvh.bytes() + size_of_val(&self.blocks[..])
    }
}

fn edges_cancel(mesh: &TriangleMesh) -> bool {
    // −0 and 0 are one place.
    let bits = |vertex: u32| mesh.positions[vertex as usize].each(|part| (part + 0.0).to_bits());
    let mut by_position: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    by_position.sort_unstable_by_key(|&vertex| bits(vertex));
    let mut first_at = vec![0; by_position.len()];
    let mut first = by_position.first().copied().unwrap_or_default();
    for &vertex in &by_position {
        first = if bits(vertex) == bits(first) { first } else { vertex };
        first_at[vertex as usize] = first;
    }
    let triangles = mesh.triangles.iter().map(|triangle| triangle.each(|vertex| first_at[vertex as usize]));
    let edges = triangles.flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]).filter(|[from, to]| from != to);
    let mut edges: Vec<(u32, u32, i32)> =
        edges.map(|[from, to]| (from.min(to), from.max(to), if from < to { 1 } else { -1 })).collect();
    edges.sort_unstable();
    edges
        .chunk_by(|one, next| (one.0, one.1) == (next.0, next.1))
        .all(|edge| edge.iter().map(|(.., step)| step).sum::<i32>() == 0)
}

// Rays through the hierarchy of a mesh, one by one.

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

/// What is added to a t to compare it with those of a ray that starts at t = `start`: more than the rounding of the sum
/// start + τ, so that ties are found.
#[inline(always)]
pub fn slack_of(start: f64) -> f64 {
    start * (1.0 / (1_u64 << 50) as f64) - start
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
        let slack = slack_of(start);
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

    /// The closer of the hit so far and the mesh's, or one of its hits where `ANY` is enough.
    #[inline(always)]
    pub fn keep_closest_until<const ANY: bool>(
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

// Coherent rays through the hierarchy of a mesh in packets.
//
// Each ray of a packet computes what it would compute alone, so its hit is the same to the last bit.

/// The most by which slopes against the longest component may differ within a packet.
const CONE: f64 = 1.0 / 8.0;
/// The most by which origins may differ, in extents of the mesh.
const SPREAD: f64 = 1.0 / 8.0;
/// The least cos² between directions that are looked at closer: a little wider than the cone, which is one of object
/// space.
const MIN_COS2: f32 = 0.9;

/// The leaves after which a packet is given up: where triangles are smaller than what lies between rays, each leaf is
/// entered by a ray or two, which get on faster apart.
const MAX_LEAVES: usize = PACKET;

/// The nodes of which a number of 32 bits can hold one and a child of it.
const MAX_NODES: usize = 1 << 29;

/// Whether the directions of a packet's rows are close enough to look at them closer.
///
/// This is one pass over a column, which is all that incoherent rays pay for packets.
#[inline(always)]
pub fn may_be_coherent(rays: RaySlices<'_>) -> bool {
    let [x, y, z] = rays.direction.each(|part| &part[..PACKET]);
    let (first_x, first_y, first_z) = (x[0], y[0], z[0]);
    let min = MIN_COS2 * (first_x * first_x + first_y * first_y + first_z * first_z);
    let mut close = true;
    for i in 0..PACKET {
        let cosine = x[i] * first_x + y[i] * first_y + z[i] * first_z;
        let length = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
        close &= (cosine > 0.0) & (cosine * cosine >= min * length);
    }
    close
}

/// A packet of rays in the object space of a mesh, and their closest hits so far.
#[derive(Default)]
pub struct MeshPacket {
    origin: [PerRay<f64>; 3],
    direction: [PerRay<f64>; 3],
    /// The axes x, y and z of the sheared space, which is that of a [`MeshRay`](super::triangle_edges::MeshRay).
    axes: [usize; 3],
    shear: [PerRay<f64>; 3],
    /// [`ROUNDING`] times a bound on every coordinate.
    rounding: PerRay<f64>,
    /// Origin, shear and rounding again, in f32 and in the sheared space's axes.
    in_f32: [PerRay<f32>; 6],
    boxes: BoxPacket,
    t: PerRay<f64>,
    shape: PerRay<u32>,
    primitive: PerRay<u32>,
    /// t as the boxes see it; negative once a ray that takes any hit has one.
    limit: PerRay<f32>,
}

impl MeshPacket {
    /// Sets one of its rays, in object space.
    #[inline(always)]
    pub fn set_ray(&mut self, row: usize, i: usize, [origin, direction]: [DVec3; 2]) {
        for axis in 0..3 {
            self.origin[axis][row][i] = origin[axis];
            self.direction[axis][row][i] = direction[axis];
        }
    }

    /// Computes what is needed of the rays once they are all set; says whether they are coherent.
    #[inline(always)]
    pub fn prepare(&mut self, hierarchy: &MeshHierarchy) -> bool {
        let first = DVec3::from([0, 1, 2].each(|axis| self.direction[axis][0][0]));
        let z = longest_axis(first);
        self.axes = [(z + 1) % 3, (z + 2) % 3, z];
        if !(self.signs_agree() && hierarchy.bvh.nodes.len() < MAX_NODES) {
            return false;
        }
        self.set_shear(hierarchy.size);
        if !self.is_coherent(hierarchy) {
            return false;
        }
        self.boxes.set(&self.origin, &self.direction, first[z]);
        true
    }

    // ANCHOR: signs_agree
    #[inline(always)]
    fn signs_agree(&self) -> bool {
        let mut differ = 0;
        for direction in &self.direction {
            let first = direction[0][0].to_bits();
            direction.as_flattened().iter().for_each(|part| differ |= part.to_bits() ^ first);
        }
        differ >> 63 == 0
    }
    // ANCHOR_END: signs_agree

    #[inline(always)]
    fn set_shear(&mut self, mesh_size: f64) {
        let [x, y, z] = self.axes.each(|axis| &self.direction[axis]);
        let [ox, oy, oz] = &self.origin;
        for row in 0..ROWS {
            for i in 0..ROW {
                self.shear[0][row][i] = x[row][i] / z[row][i];
                self.shear[1][row][i] = y[row][i] / z[row][i];
                self.shear[2][row][i] = 1.0 / z[row][i];
                let size = ox[row][i].abs() + oy[row][i].abs() + oz[row][i].abs() + mesh_size;
                self.rounding[row][i] = ROUNDING * size;
                self.in_f32[3][row][i] = self.shear[0][row][i] as f32;
                self.in_f32[4][row][i] = self.shear[1][row][i] as f32;
                self.in_f32[5][row][i] = (ROUNDING_F32 * size) as f32;
            }
        }
        for axis in 0..3 {
            let origin = &self.origin[self.axes[axis]];
            for row in 0..ROWS {
                for i in 0..ROW {
                    self.in_f32[axis][row][i] = origin[row][i] as f32;
                }
            }
        }
    }

    /// Whether the rays have one longest axis, similar lengths, and lie in a narrow cone; false if one is not finite.
    #[inline(always)]
    fn is_coherent(&self, hierarchy: &MeshHierarchy) -> bool {
        let [x, y, z] = self.axes.each(|axis| &self.direction[axis]);
        let [ox, oy, oz] = &self.origin;
        let around = &hierarchy.bvh.around;
        let extent = [0, 1, 2].each(|axis| f64::from(around.high[axis]) - f64::from(around.low[axis]));
        let spread = SPREAD * (extent[0] + extent[1] + extent[2]);
        let mut coherent = true;
        for row in 0..ROWS {
            for i in 0..ROW {
                let [a, b, c] = [x[row][i].abs(), y[row][i].abs(), z[row][i].abs()];
                // Of equal components longest_axis takes z before x, and x before y.
                let longest = match self.axes {
                    [.., 2] => (c >= a) & (c >= b),
                    [.., 1] => (c > a) & (c > b),
                    _ => (c >= a) & (c > b),
                };
                let slopes = (self.shear[0][row][i] - self.shear[0][0][0]).abs()
                    + (self.shear[1][row][i] - self.shear[1][0][0]).abs();
                let apart =
                    (ox[row][i] - ox[0][0]).abs() + (oy[row][i] - oy[0][0]).abs() + (oz[row][i] - oz[0][0]).abs();
                let length = z[0][0].abs();
                let similar = (c >= 0.5 * length) & (c <= 2.0 * length) & (c < f64::INFINITY);
                coherent &= longest & similar & (slopes <= CONE) & (apart <= spread);
            }
        }
        coherent
    }

    /// Intersects the packet with the mesh and keeps the closest hits of the rows from `start` on; says whether it came
    /// to the end, and otherwise the rays are still to be intersected apart.
    #[inline(always)]
    pub fn keep_closest<const ANY: bool>(
        &mut self,
        hierarchy: &MeshHierarchy,
        number: u32,
        start: usize,
        hits: &mut ClosestHits<'_>,
        stack: &mut Stack,
    ) -> bool {
        for place in 0..PACKET {
            let (row, i, closest) = (place / ROW, place % ROW, hits.get(start + place));
            (self.t[row][i], self.shape[row][i]) = (closest.t, closest.shape);
            self.primitive[row][i] = closest.primitive;
            self.limit[row][i] = if closest.is_enough() { -1.0 } else { self.boxes.limit(closest.t) };
        }
        let is_done = self.traverse::<ANY>(hierarchy, number, stack);
        for place in 0..PACKET {
            let (row, i, closest) = (place / ROW, place % ROW, hits.get(start + place));
            let (t, shape, primitive) = (self.t[row][i], self.shape[row][i], self.primitive[row][i]);
            hits.set(start + place, ClosestHit { t, shape, primitive, ..closest });
        }
        is_done
    }

    /// Visits the leaves that any of the rays enters, the nearest first; says whether it came to the end.
    ///
    /// An entry of the stack is a node and a child of it, whose box a row of rays is tested against before they are
    /// tested against the triangles of a leaf.
    #[inline(always)]
    fn traverse<const ANY: bool>(&mut self, hierarchy: &MeshHierarchy, number: u32, stack: &mut Stack) -> bool {
        let nodes = &hierarchy.bvh.nodes;
        let mut leaves = 0;
        let (mut limit, mut height, mut at, mut from) = (self.farthest(), 0, 0, [0.0; WIDTH]);
        while at < nodes.len() {
            let mut mask = self.boxes.enters(&nodes[at], limit, &mut from);
            let base = height;
            while mask != 0 {
                let child = take_first(&mut mask);
                stack.sort_in(base, height, Stack::entry(from[child], (at * WIDTH + child) as u32));
                height += 1;
            }
            at = usize::MAX;
            while at == usize::MAX && height > 0 {
                height -= 1;
                let (from, place) = Stack::parts(stack.at(height));
                if from > limit {
                    continue;
                }
                let (node, child) = (&nodes[place as usize / WIDTH], place as usize % WIDTH);
                match node.child[child].kind() {
                    ChildKind::Node(number) => at = number,
                    ChildKind::Leaf(leaf) => {
                        leaves += 1;
                        if leaves > MAX_LEAVES {
                            return false;
                        }
                        let mut tested = false;
                        for row in 0..ROWS {
                            if self.boxes.row_enters(node, child, row, &self.limit[row]) {
                                self.test_row::<ANY>(row, &hierarchy.blocks[leaf], number);
                                tested = true;
                            }
                        }
                        limit = if tested { self.farthest() } else { limit };
                        if ANY && limit < 0.0 {
                            return true;
                        }
                    }
                }
            }
        }
        true
    }

    /// The largest limit of any ray.
    #[inline(always)]
    fn farthest(&self) -> f32 {
        let larger = |a: f32, b: f32| if a > b { a } else { b };
        let mut farthest = self.limit[0];
        for row in &self.limit[1..] {
            for i in 0..ROW {
                farthest[i] = larger(farthest[i], row[i]);
            }
        }
        farthest.into_iter().fold(farthest[0], larger)
    }

    /// Eight rays against the triangles of a leaf: what [`TriangleBlock::keep_closest`] does, one triangle at a time.
    #[inline(always)]
    fn test_row<const ANY: bool>(&mut self, row: usize, block: &TriangleBlock, number: u32) {
        let [x, y, z] = self.axes;
        let (ox, oy, oz) = (self.origin[x][row], self.origin[y][row], self.origin[z][row]);
        let (shear_x, shear_y, shear_z) = (self.shear[0][row], self.shear[1][row], self.shear[2][row]);
        let rounding = self.rounding[row];
        for (lane, triangle) in block.triangles() {
            let corners = block.corners_of(lane, self.axes);
            if !self.any_may_hit(row, corners) {
                continue;
            }
            let corners = in_f64(corners);
            let (mut areas, mut depths) = ([[0.0_f64; ROW]; 3], [[0.0_f64; ROW]; 3]);
            let (mut errors, mut may_hit) = ([0.0_f64; ROW], [0_u8; ROW]);
            for i in 0..ROW {
                let (origin, shear) = ([ox[i], oy[i], oz[i]], [shear_x[i], shear_y[i], shear_z[i]]);
                let ([u, v, w], [az, bz, cz], error) = edge_values(corners, origin, shear, rounding[i]);
                (areas[0][i], areas[1][i], areas[2][i]) = (u, v, w);
                (depths[0][i], depths[1][i], depths[2][i]) = (az, bz, cz);
                errors[i] = error;
                may_hit[i] = may_be_hit([u, v, w], error);
            }
            let mut may_hit = u64::from_le_bytes(may_hit);
            while may_hit != 0 {
                let i = take_first(&mut may_hit);
                if ANY && self.limit[row][i] < 0.0 {
                    continue;
                }
                let values =
                    ([areas[0][i], areas[1][i], areas[2][i]], [depths[0][i], depths[1][i], depths[2][i]], errors[i]);
                let t = certain_t(values, shear_z[i]).unwrap_or_else(|| self.exact_t(row, i, block, lane));
                let lower = (number, triangle) < (self.shape[row][i], self.primitive[row][i]);
                if t < self.t[row][i] || (t == self.t[row][i] && lower && t < f64::INFINITY) {
                    (self.t[row][i], self.shape[row][i], self.primitive[row][i]) = (t, number, triangle);
                    self.limit[row][i] = if ANY { -1.0 } else { self.boxes.limit(t) };
                }
            }
        }
    }

    /// Whether f32 leaves it open that one of eight rays hits a triangle.
    #[inline(always)]
    fn any_may_hit(&self, row: usize, corners: [[f32; 3]; 3]) -> bool {
        let [ox, oy, oz] = [0, 1, 2].each(|part| &self.in_f32[part][row]);
        let [shear_x, shear_y, rounding] = [3, 4, 5].each(|part| &self.in_f32[part][row]);
        let mut may_hit = [0; ROW];
        for i in 0..ROW {
            let ray = ([ox[i], oy[i], oz[i]], [shear_x[i], shear_y[i]], rounding[i]);
            may_hit[i] = may_be_hit_in_f32(corners, ray);
        }
        u64::from_le_bytes(may_hit) != 0
    }

    #[cold]
    #[inline(never)]
    fn exact_t(&self, row: usize, i: usize, block: &TriangleBlock, lane: usize) -> f64 {
        let vector = |parts: &[PerRay<f64>; 3]| DVec3::from([0, 1, 2].each(|axis| parts[axis][row][i]));
        exact_triangle_t(vector(&self.origin), vector(&self.direction), &block.row(lane))
    }
}
