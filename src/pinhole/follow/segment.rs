//! The segments between surfaces of camera paths and vertices of light paths, of which many are computed at once.
//!
//! Reads: surfaces, and vertices that a light path has left.
//! Space: render space; the frame of the vertex for what its BSDF is asked.

use super::LightVertex;
use crate::each::{Each, by_lane};
use crate::intersect::falling_cosine;
use crate::material::{MaterialKind, frame_about};
use crate::plan::{VectorRows, VectorRowsMut};
use crate::shade::join_cosine;
use crate::shapes::offset_origin;
use glam::{DVec3, Vec3};
use multiversion::multiversion;

/// A surface of a camera path, where rays to light vertices start.
#[derive(Clone, Copy)]
pub struct JoinedSurface {
    pub(super) row: u32,
    pub(super) kind: MaterialKind,
    pub(super) origin: Vec3,
    pub(super) normal: Vec3,
    pub(super) shaded: DVec3,
}

/// A ray from a surface to a light vertex.
pub(super) struct Segment {
    pub direction: DVec3,
    /// Its length, squared.
    pub square: f64,
    /// The cosines of both ends over that.
    pub geometry: f64,
}

// ANCHOR: join_segment
/// The ray from a surface to a light vertex, given by its position, normal, shading normal and the direction that its light
/// comes from; and whether both ends face each other.
///
/// There is no branch, so that rows are computed side by side.
#[inline(always)]
fn segment(
    [origin, normal, shaded]: [DVec3; 3],
    [position, vertex_normal, shading, source]: [Vec3; 4],
    bound: f32,
    transmits: bool,
) -> (Segment, bool) {
    let outward = vertex_normal.as_dvec3();
    let seen = (origin - position.as_dvec3()).dot(outward);
    let side = if seen < 0.0 { -vertex_normal } else { vertex_normal };
    let to_light = offset_origin(position, side, bound).as_dvec3() - origin;
    let square = to_light.length_squared();
    let direction = to_light * (1.0 / square.sqrt());
    let (leaving, arriving) = (outward.dot(direction).abs(), falling_cosine(normal, shaded, direction));

    // A shading normal counts arriving light by its own cosine (Veach 1997, 5.3).
    let (source, shading) = (source.as_dvec3(), shading.as_dvec3());
    let sent = join_cosine(leaving, outward.dot(source), falling_cosine(outward, shading, source));
    let sends = ((seen > 0.0) | (transmits & (seen < 0.0))) & (side.as_dvec3().dot(direction) < 0.0);
    let counts = sends & (square >= f64::MIN_POSITIVE) & (arriving > 0.0);
    (Segment { direction, square, geometry: sent * arriving / square }, counts)
}
// ANCHOR_END: join_segment

/// How many segments are computed at once.
pub(super) const AT_ONCE: usize = 32;

/// Surfaces and light vertices, component by component, and the segments between them.
pub(super) struct SegmentBlock {
    origin: [[f32; AT_ONCE]; 3],
    normal: [[f32; AT_ONCE]; 3],
    shaded: [[f64; AT_ONCE]; 3],
    vertex: [[[f32; AT_ONCE]; 3]; 4],
    bound: [f32; AT_ONCE],
    direction: [[f64; AT_ONCE]; 3],
    square: [f64; AT_ONCE],
    geometry: [f64; AT_ONCE],
    /// In the frame of the vertex: where the segment comes from, and where the light does.
    local: [[[f64; AT_ONCE]; 3]; 2],
    counts: [u32; AT_ONCE],
}

impl SegmentBlock {
    pub const NONE: Self = Self {
        origin: [[0.0; AT_ONCE]; 3],
        normal: [[0.0; AT_ONCE]; 3],
        shaded: [[0.0; AT_ONCE]; 3],
        vertex: [[[0.0; AT_ONCE]; 3]; 4],
        bound: [0.0; AT_ONCE],
        direction: [[0.0; AT_ONCE]; 3],
        square: [0.0; AT_ONCE],
        geometry: [0.0; AT_ONCE],
        local: [[[0.0; AT_ONCE]; 3]; 2],
        counts: [0; AT_ONCE],
    };

    /// Gathers pairs of a surface and a vertex; what follows the last pair is left over from an earlier block.
    #[inline(always)]
    pub fn gather(&mut self, surfaces: &[JoinedSurface], vertices: &[LightVertex], pairs: &[[u32; 2]]) {
        for (lane, [surface, vertex]) in by_lane::<AT_ONCE, _>(pairs) {
            let (surface, vertex) = (&surfaces[surface as usize], &vertices[vertex as usize]);
            self.origin.put(lane, surface.origin);
            self.normal.put(lane, surface.normal);
            self.shaded.put(lane, surface.shaded);
            let vectors = [vertex.position, vertex.normal, vertex.shading, vertex.to_light];
            for (to, vector) in self.vertex.iter_mut().zip(vectors) {
                to.put(lane, vector);
            }
            self.bound[lane] = vertex.bound;
        }
    }

    /// A segment, and in the frame of its vertex the directions where it comes from and where the light does.
    #[inline(always)]
    pub fn get(&self, lane: usize) -> (Segment, [DVec3; 2]) {
        let (square, geometry) = (self.square[lane], self.geometry[lane]);
        let segment = Segment { direction: self.direction.at(lane).into(), square, geometry };
        (segment, [0, 1].each(|vector: usize| self.local[vector].at(lane).into()))
    }

    /// The lanes of the first pairs whose ends face each other, and how many there are.
    #[inline(always)]
    pub fn those(&self, pairs: usize) -> ([u32; AT_ONCE], usize) {
        let (mut lanes, mut count) = ([0; AT_ONCE], 0);
        for (lane, counts) in by_lane::<AT_ONCE, _>(&self.counts[..pairs.min(AT_ONCE)]) {
            lanes[count % AT_ONCE] = lane as u32;
            count += counts as usize;
        }
        (lanes, count)
    }
}

/// Computes the segments of a block.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
pub(super) fn segments(block: &mut SegmentBlock, transmits: bool, narrow: bool) {
    for lane in 0..AT_ONCE {
        let [origin, normal] = [&block.origin, &block.normal].each(|vectors| Vec3::from(vectors.at(lane)).as_dvec3());
        let vertex = [0, 1, 2, 3].each(|vector| Vec3::from(block.vertex[vector].at(lane)));
        let ends = [origin, normal, block.shaded.at(lane).into()];
        let (Segment { direction, square, geometry }, counts) = segment(ends, vertex, block.bound[lane], transmits);
        let local_from_world = frame_about(vertex[2].as_dvec3(), narrow).transpose();
        block.direction.put(lane, direction);
        block.local[0].put(lane, local_from_world * -direction);
        block.local[1].put(lane, local_from_world * vertex[3].as_dvec3());
        (block.square[lane], block.geometry[lane], block.counts[lane]) = (square, geometry, u32::from(counts));
    }
}
