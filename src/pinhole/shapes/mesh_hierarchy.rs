use super::ray_block::ClosestHit;
use super::triangle_block::{BLOCK, MeshRay, TriangleBlock};
use crate::bvh::{BoundingBox, Bvh};
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
        let size_of = |position: &[f32; 3]| position.map(|part| f64::from(part.abs())).iter().sum();
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
            let sides = [self.bvh.around.low, self.bvh.around.high].map(|side| DVec3::from(side.map(f64::from)));
            let corner = |at: usize| DVec3::new(sides[at & 1].x, sides[at >> 1 & 1].y, sides[at >> 2].z);
            return extent(&mut (0..8).map(corner));
        }
        let vertices = mesh.triangles.iter().flatten();
        extent(&mut vertices.map(|&vertex| DVec3::from(mesh.positions[vertex as usize].map(f64::from))))
    }

    /// The memory of its arrays, in bytes.
    pub fn bytes(&self) -> usize {
        self.bvh.bytes() + size_of_val(&self.blocks[..])
    }
}

fn edges_cancel(mesh: &TriangleMesh) -> bool {
    // −0 and 0 are one place.
    let bits = |vertex: u32| mesh.positions[vertex as usize].map(|part| (part + 0.0).to_bits());
    let mut by_position: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    by_position.sort_unstable_by_key(|&vertex| bits(vertex));
    let mut first_at = vec![0; by_position.len()];
    let mut first = by_position.first().copied().unwrap_or_default();
    for &vertex in &by_position {
        first = if bits(vertex) == bits(first) { first } else { vertex };
        first_at[vertex as usize] = first;
    }
    let triangles = mesh.triangles.iter().map(|triangle| triangle.map(|vertex| first_at[vertex as usize]));
    let edges = triangles.flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]).filter(|[from, to]| from != to);
    let mut edges: Vec<(u32, u32, i32)> =
        edges.map(|[from, to]| (from.min(to), from.max(to), if from < to { 1 } else { -1 })).collect();
    edges.sort_unstable();
    edges
        .chunk_by(|one, next| (one.0, one.1) == (next.0, next.1))
        .all(|edge| edge.iter().map(|(.., step)| step).sum::<i32>() == 0)
}
