//! Rays and triangles: the sheared space of a ray, the three edge functions, and the kernel over all triangles.

use super::ray_block::{ClosestHit, Intersection, LANES, RayBlock, RaySlices, UNIT_ROUNDOFF, nearness, vector};
use super::triangle::{TriangleRow, exact_triangle_t};
use crate::bvh::{by_axis, take_first};
use crate::each::Each;
use glam::DVec3;
use pinhole_models::TriangleMesh;

// ANCHOR: shear
/// The shear and scale that map a ray's direction to (0, 0, 1), with z the axis of its largest component.
///
/// It is computed once per ray, whatever the number of triangles (Woop, Benthin and Wald, *Watertight Ray/Triangle
/// Intersection*, 2013).
#[derive(Clone, Copy, Debug)]
pub struct Shear {
    /// Rx / Rz, from −1 to 1.
    pub x: f64,
    /// Ry / Rz, from −1 to 1.
    pub y: f64,
    /// 1 / Rz.
    pub z: f64,
}

impl Shear {
    /// The shear of a direction whose largest component is along `Z`; the next axes, cyclically, are x and y.
    #[inline(always)]
    pub fn along<const Z: usize>(direction: DVec3) -> Self {
        let [x, y, z] = permuted::<Z>(direction);
        Self { x: x / z, y: y / z, z: 1.0 / z }
    }
}

/// The components of a vector, cyclically permuted so that axis `Z` becomes z.
#[inline(always)]
pub(super) fn permuted<const Z: usize>(v: DVec3) -> [f64; 3] {
    match Z {
        0 => [v.y, v.z, v.x],
        1 => [v.z, v.x, v.y],
        _ => [v.x, v.y, v.z],
    }
}

/// The axis of a direction's largest component.
#[inline(always)]
pub fn longest_axis(direction: DVec3) -> usize {
    let DVec3 { x, y, z } = direction.abs();
    if z >= x && z >= y { 2 } else { usize::from(y > x) }
}
// ANCHOR_END: shear

/// A triangle in the sheared space of a ray, which starts at the origin and goes along z.
#[derive(Clone, Copy, Debug)]
pub struct Edges {
    /// The edge functions: twice the signed areas opposite each vertex.
    pub areas: [f64; 3],
    /// The depth of each vertex along axis z, not yet divided by Rz.
    pub depths: [f64; 3],
    /// A bound on the rounding error of each area.
    pub error: f64,
}

// ANCHOR: edges
/// The three edge functions of a triangle in the sheared space of a ray, in f64.
///
/// With ε = 2⁻⁵³ and s = |O|₁ + |vertex|₁, a vertex's sheared x is off by 5εs: ε for subtracting O, 3ε for the product,
/// ε for the difference, and a little for second-order terms.
/// An area multiplies two such coordinates twice and adds the rounding of the products, which is at most 10εs(m + 5εs),
/// where m is the sum of the six sheared coordinates' magnitudes.
/// Two triangles with a common edge compute it from the same numbers, so no ray passes between them.
#[inline(always)]
pub fn edges<const Z: usize>(origin: DVec3, shear: Shear, triangle: &TriangleRow, ray_size: f64) -> Edges {
    const ROUNDING: f64 = 1.0 / (1_u64 << 49) as f64;
    let sheared = |vertex: DVec3| {
        let [x, y, z] = permuted::<Z>(vertex - origin);
        (x - shear.x * z, y - shear.y * z, z)
    };
    let [a, b, c] = triangle.corners;
    let ((ax, ay, az), (bx, by, bz), (cx, cy, cz)) = (sheared(a), sheared(b), sheared(c));
    let areas = [bx * cy - by * cx, cx * ay - cy * ax, ax * by - ay * bx];
    let lengths = ax.abs() + ay.abs() + bx.abs() + by.abs() + cx.abs() + cy.abs();
    let size = ray_size + triangle.size;
    let error = ROUNDING * size * (lengths + ROUNDING * size);
    Edges { areas, depths: [az, bz, cz], error }
}
// ANCHOR_END: edges

// ANCHOR: triangle_intersection
/// Intersects O + tR with a triangle, in f64.
///
/// It is a hit if the three areas have the same sign, where 0 counts as either; t is the mean of the vertices' depths
/// with the areas as weights.
/// The result is uncertain if rounding could have changed the sign of an area, or t by more than 2⁻²⁵ relative to
/// itself or across 0.
#[inline(always)]
pub fn intersection<const Z: usize>(
    origin: DVec3,
    shear: Shear,
    triangle: &TriangleRow,
    ray_size: f64,
) -> Intersection {
    let Edges { areas: [u, v, w], depths: [az, bz, cz], error } = edges::<Z>(origin, shear, triangle, ray_size);
    let (min, max) = (u.min(v).min(w), u.max(v).max(w));
    let misses = (min < -error) & (max > error);
    let inside = (min > error) | (max < -error);

    let (whole, sum) = (u + v + w, u * az + v * bz + w * cz);
    let t = sum / whole * shear.z;
    let sum_error = 2.0 * error * (az.abs() + bz.abs() + cz.abs());
    let unsure = (sum_error >= 0.25 * UNIT_ROUNDOFF * sum.abs()) | (4.0 * error >= 0.25 * UNIT_ROUNDOFF * whole.abs());
    let behind = (t <= 0.0) & (sum.abs() > sum_error);
    // A ray that is not finite has an error that is not finite, and misses.
    let uncertain = !misses & !(inside & (behind | !unsure)) & (error < f64::INFINITY);
    Intersection { t: if inside & (t > 0.0) { t } else { f64::INFINITY }, uncertain }
}
// ANCHOR_END: triangle_intersection

/// Intersects a ray with a triangle, in f64.
pub fn triangle_intersection(origin: DVec3, direction: DVec3, triangle: &TriangleRow) -> Intersection {
    let size = origin.abs().element_sum();
    match longest_axis(direction) {
        0 => intersection::<0>(origin, Shear::along::<0>(direction), triangle, size),
        1 => intersection::<1>(origin, Shear::along::<1>(direction), triangle, size),
        _ => intersection::<2>(origin, Shear::along::<2>(direction), triangle, size),
    }
}

/// The t > 0 at which O + tR hits a triangle, or infinity; uncertain cases are decided by exact arithmetic.
pub fn triangle_t(origin: DVec3, direction: DVec3, triangle: &TriangleRow) -> f64 {
    let intersection = triangle_intersection(origin, direction, triangle);
    if intersection.uncertain { exact_triangle_t(origin, direction, triangle) } else { intersection.t }
}

/// The number of rays that are sorted together.
const CHUNK: usize = 1024;

/// Tests one triangle at a time against blocks of the listed rays; where none of a block intersects its bounding sphere,
/// the block is skipped.
///
/// Rays are sorted by the axis of their largest component, so that each block needs one kind of shear.
#[inline(always)]
pub(super) fn rows_by_axis(
    triangles: &[TriangleRow],
    numbers: &[u32],
    rays: RaySlices<'_>,
    rows: &[u32],
    t: &mut [f64],
    shape: &mut [u32],
) {
    for rows in rows.chunks(CHUNK) {
        let ByAxis { order, ends: [first, second, third] } = ByAxis::of(rays, rows);
        rows_along::<0>(rays, &order[..first], (triangles, numbers), t, shape);
        rows_along::<1>(rays, &order[first..second], (triangles, numbers), t, shape);
        rows_along::<2>(rays, &order[second..third], (triangles, numbers), t, shape);
    }
}

/// Rows sorted by the axis of their rays' largest component, and the end of each axis's range.
struct ByAxis {
    order: [u32; CHUNK],
    ends: [usize; 3],
}

impl ByAxis {
    #[inline(always)]
    fn of(rays: RaySlices<'_>, rows: &[u32]) -> Self {
        let mut axes = [0_u8; CHUNK];
        let mut counts = [0_usize; 3];
        let [dx, dy, dz] = rays.direction;
        for (&row, axis) in rows.iter().zip(&mut axes) {
            let row = row as usize;
            let longest = longest_axis(DVec3::new(f64::from(dx[row]), f64::from(dy[row]), f64::from(dz[row])));
            *axis = longest as u8;
            counts[longest] += 1;
        }
        let mut order = [0; CHUNK];
        let mut next = [0, counts[0], counts[0] + counts[1]];
        for (&row, &axis) in rows.iter().zip(&axes) {
            order[next[usize::from(axis)]] = row;
            next[usize::from(axis)] += 1;
        }
        Self { order, ends: next }
    }
}

/// Keeps the closest hits of the listed rows, whose rays all have their largest component along `Z`.
#[inline(always)]
fn rows_along<const Z: usize>(
    rays: RaySlices<'_>,
    rows: &[u32],
    (triangles, numbers): (&[TriangleRow], &[u32]),
    t: &mut [f64],
    shape: &mut [u32],
) {
    for rows in rows.chunks(LANES) {
        let block = RayBlock::of_rows(rays, rows);
        let (inverse, RayBlock { o, d }) = (block.inverses(), &block);
        let (mut x, mut y, mut z, mut size) = ([0.0; LANES], [0.0; LANES], [1.0; LANES], [0.0; LANES]);
        let (mut own_t, mut own_shape) = ([f64::NEG_INFINITY; LANES], [0; LANES]);
        for (lane, &row) in rows.iter().enumerate() {
            let shear = Shear::along::<Z>(vector(d, lane));
            (x[lane], y[lane], z[lane]) = (shear.x, shear.y, shear.z);
            size[lane] = vector(o, lane).abs().element_sum();
            (own_t[lane], own_shape[lane]) = (t[row as usize], shape[row as usize]);
        }
        let sheared = [x, y, z, size];
        for place in 0..triangles.len() {
            let (triangle, number) = (&triangles[place], numbers[place]);
            let mut nearest = [f64::NEG_INFINITY; LANES];
            for (lane, nearness_of_lane) in nearest.iter_mut().enumerate() {
                let f = triangle.centre - vector(o, lane);
                *nearness_of_lane = nearness(f, vector(d, lane), inverse[lane], triangle.bounding_radius);
            }
            if nearest.iter().any(|&nearness| nearness >= 0.0) {
                let (t, shape) = (&mut own_t[..rows.len()], &mut own_shape[..rows.len()]);
                keep_closest::<Z>([o, d], &sheared, triangle, number, t, shape);
            }
        }
        for (lane, &row) in rows.iter().enumerate() {
            (t[row as usize], shape[row as usize]) = (own_t[lane], own_shape[lane]);
        }
    }
}

/// The shears x, y and z of a block of rays, and |O|₁.
type Sheared = [[f64; LANES]; 4];

/// Keeps the closest hits of one block of rays, which all have their largest component along `Z`.
#[inline(always)]
fn keep_closest<const Z: usize>(
    [o, d]: [&[[f64; LANES]; 3]; 2],
    [x, y, z, size]: &Sheared,
    triangle: &TriangleRow,
    number: u32,
    t: &mut [f64],
    shape: &mut [u32],
) {
    let (mut found, mut uncertain) = ([f64::INFINITY; LANES], [false; LANES]);
    for lane in 0..LANES {
        let shear = Shear { x: x[lane], y: y[lane], z: z[lane] };
        let intersection = intersection::<Z>(vector(o, lane), shear, triangle, size[lane]);
        (found[lane], uncertain[lane]) = (intersection.t, intersection.uncertain);
    }
    for (lane, (t, shape)) in t.iter_mut().zip(shape).enumerate() {
        if uncertain[lane] {
            found[lane] = exact_triangle_t(vector(o, lane), vector(d, lane), triangle);
        }
        if found[lane] < *t || (found[lane] == *t && number < *shape && found[lane] < f64::INFINITY) {
            (*t, *shape) = (found[lane], number);
        }
    }
}

// Eight triangles of a mesh against one ray.

/// The triangles of a block.
pub const BLOCK: usize = 8;
/// The relative error of an edge function, as [`edges`](super::triangle_edges::edges) derives it.
pub(super) const ROUNDING: f64 = 1.0 / (1_u64 << 49) as f64;

/// A leaf of a mesh's hierarchy: eight triangles as a structure of arrays, so that one ray is tested against all of them
/// at once.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct TriangleBlock {
    /// Positions, by vertex, axis and triangle; 0 where there is no triangle.
    corners: [[[f32; BLOCK]; 3]; 3],
    /// The triangles' numbers; [`NO_TRIANGLE`] where there is none.
    triangle: [u32; BLOCK],
}

/// The number of no triangle.
const NO_TRIANGLE: u32 = u32::MAX;

impl TriangleBlock {
    /// The block of these triangles, at most eight.
    pub fn of(mesh: &TriangleMesh, triangles: &[u32]) -> Self {
        let mut block = Self { corners: [[[0.0; BLOCK]; 3]; 3], triangle: [NO_TRIANGLE; BLOCK] };
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
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshRay {
    /// Where it starts.
    pub origin: DVec3,
    /// Its direction.
    pub direction: DVec3,
    /// The t at which it starts.
    pub start: f64,
    /// The axes x, y and z of the sheared space; z is that of the direction's largest component.
    axes: [usize; 3],
    shear: [f64; 3],
    /// |O|₁ and the largest |vertex|₁ of the mesh.
    size: f64,
    /// The same, rounded to f32.
    in_f32: RayInF32,
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
        let at = by_axis(|axis| origin[axes[axis]] as f32);
        let in_f32 = (at, [shear[0] as f32, shear[1] as f32], (ROUNDING_F32 * size) as f32);
        Self { origin, direction, start, axes, shear, size, in_f32 }
    }
}

/// What the edge functions say of a ray and a triangle: the three areas, the depths of the vertices along the ray, and
/// the areas' error.
pub(super) type EdgeValues = ([f64; 3], [f64; 3], f64);

/// [`ROUNDING`] for f32, where the origin and the shear are rounded as well: with u = 2⁻²⁴ a sheared coordinate is off by
/// at most 8us in place of 5εs, and an area by 16us(m + 8us).
///
/// The m that f32 finds is off by six such coordinates itself; 32 in place of 16 covers that too.
pub(super) const ROUNDING_F32: f64 = 1.0 / (1_u64 << 19) as f64;

impl TriangleBlock {
    /// The triangles that a ray may hit, as a byte each, 0 or 1: of most blocks that it looks into it hits none, and f32,
    /// which says so of eight at a time, leaves only those to f64 of which it is not certain.
    #[inline(always)]
    pub fn may_hit(&self, ray: &MeshRay) -> u64 {
        let corners = by_axis(|corner| by_axis(|axis| &self.corners[corner][ray.axes[axis] % 3]));
        let mut may_hit = [0; BLOCK];
        for lane in 0..BLOCK {
            let triangle = by_axis(|corner| by_axis(|axis| corners[corner][axis][lane]));
            may_hit[lane] = may_be_hit_in_f32(triangle, ray.in_f32) & u8::from(self.triangle[lane] != NO_TRIANGLE);
        }
        u64::from_le_bytes(may_hit)
    }

    /// Keeps the closest hit among the triangles of a mask such as [`Self::may_hit`] gives: the same arithmetic as
    /// [`intersection`](super::triangle_edges::intersection), and exact arithmetic where that is uncertain.
    ///
    /// At equal distances the lower `number` wins, where all of a mesh have one, and then the lower triangle.
    #[inline(always)]
    pub fn keep_closest_among(&self, mut mask: u64, ray: &MeshRay, number: u32, closest: &mut ClosestHit) {
        let origin = by_axis(|axis| ray.origin[ray.axes[axis]]);
        while mask != 0 {
            let lane = take_first(&mut mask);
            let values = edge_values(in_f64(self.corners_of(lane, ray.axes)), origin, ray.shear, ROUNDING * ray.size);
            if may_be_hit(values.0, values.2) == 0 {
                continue;
            }
            let t = certain_t(values, ray.shear[2]);
            let t = ray.start + t.unwrap_or_else(|| exact_triangle_t(ray.origin, ray.direction, &self.row(lane)));
            let triangle = self.triangle[lane];
            let lower = (number, triangle) < (closest.shape, closest.primitive);
            if t < closest.t || (t == closest.t && lower && t < f64::INFINITY) {
                *closest = ClosestHit { t, shape: number, primitive: triangle, ..*closest };
            }
        }
    }

    /// Keeps the closest hit among all of its triangles.
    #[inline(always)]
    pub fn keep_closest(&self, ray: &MeshRay, number: u32, closest: &mut ClosestHit) {
        self.keep_closest_among(self.may_hit(ray), ray, number, closest);
    }

    /// Its triangles, each with its place in the block.
    #[inline(always)]
    pub(super) fn triangles(&self) -> impl Iterator<Item = (usize, u32)> {
        self.triangle.into_iter().enumerate().take_while(|&(_, triangle)| triangle != NO_TRIANGLE)
    }

    /// The vertices of a triangle, whose axes are permuted.
    #[inline(always)]
    pub(super) fn corners_of(&self, lane: usize, axes: [usize; 3]) -> [[f32; 3]; 3] {
        by_axis(|corner| by_axis(|axis| self.corners[corner][axes[axis] % 3][lane]))
    }

    /// One of its triangles, for exact arithmetic.
    pub(super) fn row(&self, lane: usize) -> TriangleRow {
        let corners = self.corners.each(|corner| DVec3::from(corner.each(|axis| f64::from(axis[lane]))));
        TriangleRow { corners, size: 0.0, centre: DVec3::ZERO, bounding_radius: 0.0 }
    }
}

/// The vertices of a triangle in f64.
#[inline(always)]
pub(super) fn in_f64(corners: [[f32; 3]; 3]) -> [[f64; 3]; 3] {
    by_axis(|corner| by_axis(|axis| f64::from(corners[corner][axis])))
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

/// The edge functions of a triangle and the scale of depths along a ray, with axes permuted by the direction's largest
/// component: the same bits as [`edges`], without a branch, for loops over rays whose axes differ.
#[inline(always)]
pub(super) fn edge_values_by_any_axis(
    origin: [f64; 3],
    direction: [f64; 3],
    [a, b, c]: [[f64; 3]; 3],
    rounding: f64,
) -> (EdgeValues, f64) {
    let [x, y, z] = direction.each(f64::abs);
    let by_z = (z >= x) & (z >= y);
    let by_y = !by_z & (y > x);
    let pick = |one: f64, other: f64, last: f64| if by_z { one } else { if by_y { other } else { last } };
    let permuted = |[x, y, z]: [f64; 3]| [pick(x, z, y), pick(y, x, z), pick(z, y, x)];
    let [x, y, z] = permuted(direction);
    let shear = [x / z, y / z, 1.0 / z];
    (edge_values([permuted(a), permuted(b), permuted(c)], permuted(origin), shear, rounding), shear[2])
}

/// A vertex in the sheared space of a ray, but for the scale of its depth.
#[inline(always)]
fn sheared([x, y, z]: [f64; 3], origin: [f64; 3], shear: [f64; 3]) -> [f64; 3] {
    let z = z - origin[2];
    [(x - origin[0]) - shear[0] * z, (y - origin[1]) - shear[1] * z, z]
}

/// A ray in f32: its origin and its shear in the sheared space's axes, and [`ROUNDING_F32`] times the size.
pub(super) type RayInF32 = ([f32; 3], [f32; 2], f32);

/// 0 if two of a triangle's areas certainly have opposite signs, by f32 alone, and otherwise 1, for a mask of bytes.
///
/// A product too small for f32 is off by its least normal number at most; one too large makes infinity or NaN, of which
/// no comparison is certain.
#[inline(always)]
pub(super) fn may_be_hit_in_f32(corners: [[f32; 3]; 3], (origin, shear, rounding): RayInF32) -> u8 {
    let [[ax, ay], [bx, by], [cx, cy]] = [
        sheared_in_f32(corners[0], origin, shear),
        sheared_in_f32(corners[1], origin, shear),
        sheared_in_f32(corners[2], origin, shear),
    ];
    let [u, v, w] = [bx * cy - by * cx, cx * ay - cy * ax, ax * by - ay * bx];
    let lengths = ax.abs() + ay.abs() + bx.abs() + by.abs() + cx.abs() + cy.abs();
    let error = rounding * (lengths + rounding) + f32::MIN_POSITIVE;
    let some_below = (u < -error) | (v < -error) | (w < -error);
    let some_above = (u > error) | (v > error) | (w > error);
    u8::from(!(some_below & some_above))
}

/// The x and y of a vertex in the sheared space of a ray, in f32.
#[inline(always)]
fn sheared_in_f32([x, y, z]: [f32; 3], origin: [f32; 3], shear: [f32; 2]) -> [f32; 2] {
    let z = z - origin[2];
    [(x - origin[0]) - shear[0] * z, (y - origin[1]) - shear[1] * z]
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

#[cfg(test)]
mod triangle_edges_tests {
    use super::*;
    use crate::measure::draws::Draws;

    fn triangle(corners: [[f64; 3]; 3]) -> TriangleRow {
        TriangleRow::new(corners.each(DVec3::from))
    }

    /// Half of a square of side 2, three units ahead.
    fn half() -> TriangleRow {
        triangle([[-1.0, -1.0, -3.0], [1.0, -1.0, -3.0], [-1.0, 1.0, -3.0]])
    }

    #[test]
    fn both_sides_are_hit_and_only_in_front_of_the_origin() {
        let t = |origin, direction| triangle_t(origin, direction, &half());
        let at = DVec3::new(-0.5, -0.25, 0.0);
        assert_eq!(t(at, DVec3::NEG_Z), 3.0);
        assert_eq!(t(at, DVec3::NEG_Z * 2.0), 1.5);
        assert_eq!(t(at - DVec3::Z * 4.0, DVec3::Z), 1.0);
        assert_eq!(t(at, DVec3::Z), f64::INFINITY);
        assert_eq!(t(at, DVec3::X), f64::INFINITY);
        assert_eq!(t(at - DVec3::Z * 3.0, DVec3::NEG_Z), f64::INFINITY, "a ray that starts on it does not hit it");
    }

    #[test]
    fn edges_and_vertices_belong_to_it_and_the_next_number_does_not() {
        let t = |x: f64, y: f64| triangle_t(DVec3::new(x, y, 0.0), DVec3::NEG_Z, &half());
        let beyond = 1.0 + f64::EPSILON;
        for (x, y) in [(0.0, 0.0), (0.25, -0.25), (-1.0, 0.0), (0.3, -1.0), (-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)] {
            assert_eq!(t(x, y), 3.0, "({x}, {y})");
        }
        for (x, y) in [(-beyond, 0.0), (0.3, -beyond), (0.25, -0.25 + f64::EPSILON), (beyond, -1.0), (-1.0, beyond)] {
            assert_eq!(t(x, y), f64::INFINITY, "({x}, {y})");
        }
    }

    #[test]
    fn a_ray_in_its_plane_misses() {
        let edge_on = triangle([[-1.0, 0.0, -3.0], [1.0, 0.0, -3.0], [0.0, 0.0, -5.0]]);
        for origin in [DVec3::ZERO, DVec3::X * 0.25] {
            assert_eq!(triangle_t(origin, DVec3::NEG_Z, &edge_on), f64::INFINITY);
        }
        assert_eq!(triangle_t(DVec3::Y, DVec3::NEG_Z, &edge_on), f64::INFINITY);
    }

    #[test]
    fn the_order_of_vertices_changes_no_bit() {
        let corners = [[0.1, 0.2, -3.3], [1.7, -0.4, -2.9], [-0.6, 1.3, -4.1]];
        let (origin, direction) = (DVec3::new(0.01, 0.02, 0.03), DVec3::new(0.1, 0.05, -1.0));
        let t = triangle_t(origin, direction, &triangle(corners));
        assert!(t.is_finite());
        for order in [[0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
            assert_eq!(triangle_t(origin, direction, &triangle(order.map(|corner| corners[corner]))), t);
        }
    }

    /// Rays through vertices, points of edges and points inside of triangles of all sizes that f32 holds, near the origin
    /// and far from it, from near and from afar: f32 rules none of them out, but nearly all that pass clearly beside one.
    #[test]
    fn f32_rules_out_no_triangle_that_is_hit() {
        let mut draws = Draws::new(4101, 0);
        let (mut hits, mut beside, mut ruled_out) = (0, 0, 0);
        for exponent in (-149..=126).step_by(5) {
            let size = libm::ldexp(1.0, exponent);
            for (away, from) in [(0.0, 1.0), (1.0, 1.0), (100.0, 1.0), (1e6, 1.0), (0.0, 1e-3), (1.0, 1e5)] {
                for _ in 0..200 {
                    let mut vector = |length: f64| DVec3::from([(); 3].map(|()| draws.between(-length, length)));
                    let (centre, origin) = (vector(away * size), vector(from * size));
                    let corners = [(); 3].map(|()| (centre + vector(size)).to_array().each(|part| part as f32));
                    if corners.as_flattened().iter().any(|part| !part.is_finite()) {
                        continue;
                    }
                    let weights = match (4.0 * draws.unit()) as u32 {
                        0 => [1.0, 0.0, 0.0],
                        1 => [0.5, 0.5, 0.0],
                        2 => [0.3, 0.3, 0.4],
                        _ => [2.0, -0.5, -0.5],
                    };
                    let exact = corners.each(|corner| DVec3::from(corner.each(f64::from)));
                    let at = weights[0] * exact[0] + weights[1] * exact[1] + weights[2] * exact[2];
                    let origin = origin + centre;
                    let direction = (at - origin) * libm::ldexp(1.0, -exponent);
                    let mesh = TriangleMesh {
                        positions: corners.into(),
                        triangles: vec![[0, 1, 2]],
                        ..TriangleMesh::default()
                    };
                    let largest = exact.each(|corner| corner.abs().element_sum()).into_iter().fold(0.0, f64::max);
                    let ray = MeshRay::new(origin, direction, 0.0, largest);
                    let may_hit = TriangleBlock::of(&mesh, &[0]).may_hit(&ray);
                    if exact_triangle_t(origin, direction, &triangle(exact.map(|corner| corner.to_array()))).is_finite()
                    {
                        assert_eq!(may_hit, 1, "{corners:?} by a ray from {origin} along {direction}");
                        hits += 1;
                    } else if weights[0] > 1.0 && exponent.abs() < 60 && away.max(from) <= 1.0 {
                        beside += 1;
                        ruled_out += u32::from(may_hit == 0);
                    }
                }
            }
        }
        eprintln!(
            "f32: {hits} triangles hit, 0 ruled out; {beside} rays beside one of no extreme size, {ruled_out} ruled out"
        );
        assert!(hits > 10_000 && beside > 1000 && 10 * ruled_out > 9 * beside);
    }

    #[test]
    fn a_degenerate_ray_misses() {
        let (at, ahead) = (DVec3::new(-0.5, -0.25, 0.0), DVec3::NEG_Z);
        for bad in [DVec3::ZERO, DVec3::NAN, DVec3::new(0.0, 0.0, f64::NEG_INFINITY), DVec3::new(0.0, f64::NAN, -1.0)] {
            assert_eq!(triangle_t(at, bad, &half()), f64::INFINITY, "{bad}");
        }
        assert_eq!(triangle_t(DVec3::NAN, ahead, &half()), f64::INFINITY);
        let smallest = f64::from(f32::from_bits(1));
        assert_eq!(triangle_t(at, ahead * smallest, &half()), 3.0 / smallest);
        assert_eq!(triangle_t(at, DVec3::new(-0.0, -smallest, -1.0), &half()), 3.0);
    }
}
