//! Four triangles of a mesh against one ray.

use super::ray_block::{ClosestHit, UNIT_ROUNDOFF};
use super::triangle_edges::longest_axis;
use super::triangle_exact::exact_triangle_t;
use super::triangle_row::TriangleRow;
use crate::bvh::by_axis;
use glam::DVec3;
use pinhole_models::TriangleMesh;

/// The triangles of a block.
pub const BLOCK: usize = 4;
/// The relative error of an edge function, as [`edges`](super::triangle_edges::edges) derives it.
pub(super) const ROUNDING: f64 = 1.0 / (1_u64 << 49) as f64;

/// A leaf of a mesh's hierarchy: four triangles as a structure of arrays, so that one ray is tested against all of them
/// at once.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct TriangleBlock {
    /// Positions, by vertex, axis and triangle; NaN where there is no triangle.
    corners: [[[f32; BLOCK]; 3]; 3],
    /// The triangles' numbers.
    triangle: [u32; BLOCK],
}

impl TriangleBlock {
    /// The block of these triangles, at most four.
    pub fn of(mesh: &TriangleMesh, triangles: &[u32]) -> Self {
        let mut block = Self { corners: [[[f32::NAN; BLOCK]; 3]; 3], triangle: [u32::MAX; BLOCK] };
        for (lane, &triangle) in triangles.iter().enumerate() {
            block.triangle[lane] = triangle;
            for (vertex, position) in mesh.corners(triangle as usize).into_iter().enumerate() {
                for (axis, part) in position.into_iter().enumerate() {
                    block.corners[vertex][axis][lane] = part;
                }
            }
        }
        block
    }
}

/// A ray as blocks of triangles see it: its shear, computed once for all of them.
#[derive(Clone, Copy, Debug)]
pub struct MeshRay {
    origin: DVec3,
    direction: DVec3,
    /// The t at which it starts.
    start: f64,
    /// The axes x, y and z of the sheared space; z is that of the direction's largest component.
    axes: [usize; 3],
    shear: [f64; 3],
    /// |O|₁ and the largest |vertex|₁ of the mesh.
    size: f64,
}

impl MeshRay {
    /// A ray in the object space of a mesh, which starts at t = `start`; a position has at most `mesh_size` as its
    /// |x| + |y| + |z|.
    #[inline(always)]
    pub fn new(origin: DVec3, direction: DVec3, start: f64, mesh_size: f64) -> Self {
        let z = longest_axis(direction);
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let shear = [direction[axes[0]] / direction[z], direction[axes[1]] / direction[z], 1.0 / direction[z]];
        let size = origin.x.abs() + origin.y.abs() + origin.z.abs() + mesh_size;
        Self { origin, direction, start, axes, shear, size }
    }
}

/// What the edge functions say of a ray and a triangle: the three areas, the depths of the vertices along the ray, and
/// the areas' error.
pub(super) type EdgeValues = ([f64; 3], [f64; 3], f64);

impl TriangleBlock {
    /// Keeps the closest hit: the same arithmetic as [`intersection`](super::triangle_edges::intersection), four
    /// triangles at a time, and exact arithmetic where that is uncertain.
    ///
    /// At equal distances the lower `number` wins, where all of a mesh have one, and then the lower triangle.
    #[inline(always)]
    pub fn keep_closest(&self, ray: &MeshRay, number: u32, closest: &mut ClosestHit) {
        let [x_axis, y_axis, z_axis] = ray.axes;
        let [a, b, c] = &self.corners;
        let origin = [ray.origin[x_axis], ray.origin[y_axis], ray.origin[z_axis]];
        let a = [&a[x_axis], &a[y_axis], &a[z_axis]];
        let b = [&b[x_axis], &b[y_axis], &b[z_axis]];
        let c = [&c[x_axis], &c[y_axis], &c[z_axis]];
        let (mut areas, mut depths) = ([[0.0_f64; BLOCK]; 3], [[0.0_f64; BLOCK]; 3]);
        let (mut errors, mut may_hit) = ([0.0_f64; BLOCK], [0_u8; BLOCK]);
        // All of it in one loop, which the compiler turns into operations on four triangles; of several loops it would
        // unroll the first ones and shuffle what they leave behind.
        for lane in 0..BLOCK {
            let corners = [vertex_of(a, lane), vertex_of(b, lane), vertex_of(c, lane)];
            let ([u, v, w], [az, bz, cz], error) = edge_values(corners, origin, ray.shear, ROUNDING * ray.size);
            (areas[0][lane], areas[1][lane], areas[2][lane]) = (u, v, w);
            (depths[0][lane], depths[1][lane], depths[2][lane]) = (az, bz, cz);
            errors[lane] = error;
            may_hit[lane] = may_be_hit([u, v, w], error);
        }
        let mut may_hit = u32::from_le_bytes(may_hit);
        while may_hit != 0 {
            let lane = (may_hit.trailing_zeros() / 8) as usize % BLOCK;
            may_hit &= may_hit - 1;
            let values = (
                [areas[0][lane], areas[1][lane], areas[2][lane]],
                [depths[0][lane], depths[1][lane], depths[2][lane]],
                errors[lane],
            );
            let t = certain_t(values, ray.shear[2]);
            let t = ray.start + t.unwrap_or_else(|| exact_triangle_t(ray.origin, ray.direction, &self.row(lane)));
            let triangle = self.triangle[lane];
            let lower = (number, triangle) < (closest.shape, closest.primitive);
            if t < closest.t || (t == closest.t && lower && t < f64::INFINITY) {
                *closest = ClosestHit { t, shape: number, primitive: triangle, ..*closest };
            }
        }
    }

    /// Its triangles, each with its place in the block.
    #[inline(always)]
    pub(super) fn triangles(&self) -> impl Iterator<Item = (usize, u32)> {
        self.triangle.into_iter().enumerate().take_while(|&(_, triangle)| triangle != u32::MAX)
    }

    /// The vertices of a triangle, whose axes are permuted.
    #[inline(always)]
    pub(super) fn permuted(&self, lane: usize, axes: [usize; 3]) -> [[f64; 3]; 3] {
        by_axis(|corner| by_axis(|axis| f64::from(self.corners[corner][axes[axis]][lane])))
    }

    /// One of its triangles, for exact arithmetic.
    pub(super) fn row(&self, lane: usize) -> TriangleRow {
        let corners = self.corners.map(|corner| DVec3::from(corner.map(|axis| f64::from(axis[lane]))));
        TriangleRow { corners, size: 0.0, centre: DVec3::ZERO, bounding_radius: 0.0 }
    }
}

/// The edge functions of a triangle whose vertices' axes are permuted, in the sheared space of a ray; `rounding` is
/// [`ROUNDING`] times a bound on every coordinate.
#[inline(always)]
pub(super) fn edge_values(corners: [[f64; 3]; 3], origin: [f64; 3], shear: [f64; 3], rounding: f64) -> EdgeValues {
    let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] =
        [sheared(corners[0], origin, shear), sheared(corners[1], origin, shear), sheared(corners[2], origin, shear)];
    let areas = [bx * cy - by * cx, cx * ay - cy * ax, ax * by - ay * bx];
    let lengths = ax.abs() + ay.abs() + bx.abs() + by.abs() + cx.abs() + cy.abs();
    (areas, [az, bz, cz], rounding * (lengths + rounding))
}

/// A vertex in the sheared space of a ray, but for the scale of its depth.
#[inline(always)]
fn sheared([x, y, z]: [f64; 3], origin: [f64; 3], shear: [f64; 3]) -> [f64; 3] {
    let z = z - origin[2];
    [(x - origin[0]) - shear[0] * z, (y - origin[1]) - shear[1] * z, z]
}

#[inline(always)]
fn vertex_of([x, y, z]: [&[f32; BLOCK]; 3], lane: usize) -> [f64; 3] {
    [f64::from(x[lane]), f64::from(y[lane]), f64::from(z[lane])]
}

/// 1 unless two of the areas certainly have opposite signs, or the error is not finite; 0 or 1, for a mask of bytes.
#[inline(always)]
pub(super) fn may_be_hit([u, v, w]: [f64; 3], error: f64) -> u8 {
    u8::from(((min(u, v, w) >= -error) | (max(u, v, w) <= error)) & (error < f64::INFINITY))
}

/// The t > 0 of a triangle that may be hit, or infinity; none where exact arithmetic has to say.
#[inline(always)]
pub(super) fn certain_t(([u, v, w], [az, bz, cz], error): EdgeValues, shear_z: f64) -> Option<f64> {
    let (min, max) = (min(u, v, w), max(u, v, w));
    let inside = (min > error) | (max < -error);
    let (whole, sum) = (u + v + w, u * az + v * bz + w * cz);
    let t = sum / whole * shear_z;
    let sum_error = 2.0 * error * (az.abs() + bz.abs() + cz.abs());
    let unsure = (sum_error >= 0.25 * UNIT_ROUNDOFF * sum.abs()) | (4.0 * error >= 0.25 * UNIT_ROUNDOFF * whole.abs());
    let behind = (t <= 0.0) & (sum.abs() > sum_error);
    (inside & (behind | !unsure)).then_some(if inside & (t > 0.0) { t } else { f64::INFINITY })
}

/// The least of three numbers, by comparisons that compile to one instruction each.
#[inline(always)]
fn min(a: f64, b: f64, c: f64) -> f64 {
    let min = if a < b { a } else { b };
    if c < min { c } else { min }
}

#[inline(always)]
fn max(a: f64, b: f64, c: f64) -> f64 {
    let max = if a > b { a } else { b };
    if c > max { c } else { max }
}
