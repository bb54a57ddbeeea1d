//! Rays and triangles: the sheared space of a ray, the three edge functions, and the kernel over all triangles.

use super::ray_block::{Intersection, LANES, RayBlock, RaySlices, UNIT_ROUNDOFF, nearness, vector};
use super::triangle_exact::exact_triangle_t;
use super::triangle_row::TriangleRow;
use glam::DVec3;
use multiversion::multiversion;

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

/// Tests one triangle at a time against blocks of rays; where none of a block intersects its bounding sphere, the block
/// is skipped.
///
/// Rays are sorted by the axis of their largest component, so that each block needs one kind of shear.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
pub(super) fn triangle_rows(
    triangles: &[TriangleRow],
    numbers: &[u32],
    rays: RaySlices<'_>,
    t: &mut [f64],
    shape: &mut [u32],
) {
    let mut start = 0;
    while start < t.len() {
        let end = t.len().min(start + CHUNK);
        let ByAxis { order, ends: [first, second, third] } = ByAxis::of(rays, start, end);
        rows_along::<0>(rays, &order[..first], (triangles, numbers), t, shape);
        rows_along::<1>(rays, &order[first..second], (triangles, numbers), t, shape);
        rows_along::<2>(rays, &order[second..third], (triangles, numbers), t, shape);
        start = end;
    }
}

/// Rows sorted by the axis of their rays' largest component, and the end of each axis's range.
struct ByAxis {
    order: [u32; CHUNK],
    ends: [usize; 3],
}

impl ByAxis {
    #[inline(always)]
    fn of(rays: RaySlices<'_>, start: usize, end: usize) -> Self {
        let mut axes = [0_u8; CHUNK];
        let mut counts = [0_usize; 3];
        let [dx, dy, dz] = rays.direction;
        for (row, axis) in (start..end).zip(&mut axes) {
            let longest = longest_axis(DVec3::new(f64::from(dx[row]), f64::from(dy[row]), f64::from(dz[row])));
            *axis = longest as u8;
            counts[longest] += 1;
        }
        let mut order = [0; CHUNK];
        let mut next = [0, counts[0], counts[0] + counts[1]];
        for (row, &axis) in (start..end).zip(&axes) {
            order[next[usize::from(axis)]] = row as u32;
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
        let RayBlock { o, d, inverse } = RayBlock::of_rows(rays, rows);
        let (mut x, mut y, mut z, mut size) = ([0.0; LANES], [0.0; LANES], [1.0; LANES], [0.0; LANES]);
        let (mut own_t, mut own_shape) = ([f64::NEG_INFINITY; LANES], [0; LANES]);
        for (lane, &row) in rows.iter().enumerate() {
            let shear = Shear::along::<Z>(vector(&d, lane));
            (x[lane], y[lane], z[lane]) = (shear.x, shear.y, shear.z);
            size[lane] = vector(&o, lane).abs().element_sum();
            (own_t[lane], own_shape[lane]) = (t[row as usize], shape[row as usize]);
        }
        let sheared = [x, y, z, size];
        for (triangle, &number) in triangles.iter().zip(numbers) {
            let mut nearest = [f64::NEG_INFINITY; LANES];
            for (lane, nearness_of_lane) in nearest.iter_mut().enumerate() {
                let f = triangle.centre - vector(&o, lane);
                *nearness_of_lane = nearness(f, vector(&d, lane), inverse[lane], triangle.bounding_radius);
            }
            if nearest.iter().any(|&nearness| nearness >= 0.0) {
                let (t, shape) = (&mut own_t[..rows.len()], &mut own_shape[..rows.len()]);
                keep_closest::<Z>([&o, &d], &sheared, triangle, number, t, shape);
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

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(corners: [[f64; 3]; 3]) -> TriangleRow {
        TriangleRow::new(corners.map(DVec3::from))
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
