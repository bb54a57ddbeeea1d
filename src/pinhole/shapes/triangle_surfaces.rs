//! The surfaces where rays hit triangles that are known, several hits at once.

use super::ray_block::UNIT_ROUNDOFF;
use super::ray_hit::{HITS, HitBlock, at, set};
use super::triangle_block::{ROUNDING, edge_values};
use glam::{DMat3, DVec3};
use multiversion::multiversion;

/// Where a component of the cross product cancels to less than this part of what it is the difference of, f64 would turn
/// the normal of a thin triangle.
pub(super) const EXACT_BELOW: f64 = 1.0 / (1_u64 << 24) as f64;

/// The barycentric coordinates of a hit, whether the ray goes along the normal, and whether f64 is certain of both: the
/// same bits as those of [`TriangleHit::of`](super::TriangleHit::of), without a branch.
#[inline(always)]
fn barycentrics(origin: [f64; 3], direction: [f64; 3], corners: [[f64; 3]; 3]) -> ([f64; 3], bool, bool) {
    let [x, y, z] = direction.map(f64::abs);
    let by_z = (z >= x) & (z >= y);
    let by_y = !by_z & (y > x);
    let pick = |one: f64, other: f64, last: f64| if by_z { one } else { if by_y { other } else { last } };
    let permuted = |[x, y, z]: [f64; 3]| [pick(x, z, y), pick(y, x, z), pick(z, y, x)];
    let [x, y, z] = permuted(direction);
    let shear = [x / z, y / z, 1.0 / z];
    let rounding = ROUNDING * (norm(origin) + size_of_corners(corners));
    let corners = [permuted(corners[0]), permuted(corners[1]), permuted(corners[2])];
    let ([u, v, w], _, error) = edge_values(corners, permuted(origin), shear, rounding);
    let whole = u + v + w;
    let [u, v, w] = [not_negative(u / whole), not_negative(v / whole), not_negative(w / whole)];
    let sum = u + v + w;
    let certain = 4.0 * error < 0.25 * UNIT_ROUNDOFF * whole.abs();
    ([u / sum, v / sum, w / sum], whole * shear[2] > 0.0, certain)
}

#[inline(always)]
fn norm([x, y, z]: [f64; 3]) -> f64 {
    x.abs() + y.abs() + z.abs()
}

#[inline(always)]
fn size_of_corners([a, b, c]: [[f64; 3]; 3]) -> f64 {
    max(norm(a), max(norm(b), norm(c)))
}

/// The largest magnitude of a component.
#[inline(always)]
fn largest(vector: DVec3) -> f64 {
    max(vector.x.abs(), max(vector.y.abs(), vector.z.abs()))
}

#[inline(always)]
fn not_negative(number: f64) -> f64 {
    if number < 0.0 { 0.0 } else { number }
}

/// The greater of two numbers, in the one instruction that `f64::max` is not.
#[inline(always)]
fn max(one: f64, other: f64) -> f64 {
    if one > other { one } else { other }
}

#[inline(always)]
fn interpolated([u, v, w]: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    [u * a[0] + v * b[0] + w * c[0], u * a[1] + v * b[1] + w * c[1], u * a[2] + v * b[2] + w * c[2]]
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
pub(super) fn interpolate_triangles(hits: &mut HitBlock) {
    for lane in 0..HITS {
        let corners = hits.corners_at(lane);
        let (weights, along, certain) = barycentrics(at(&hits.origin, lane), at(&hits.direction, lane), corners);
        set(&mut hits.at, lane, weights);
        set(&mut hits.point, lane, interpolated(weights, corners));
        let is_turned = hits.outside[lane] > 0.0;
        hits.face(lane, at(&hits.normal, lane), along == is_turned, size_of_corners(corners));
        hits.certain[lane] = if certain { 1.0 } else { 0.0 };
    }
}

/// What takes rays to the object space of a mesh, and its triangles out of it.
pub(super) struct ObjectMaps {
    pub object_from_world: DMat3,
    pub world_from_object: DMat3,
    pub normal_from_object: DMat3,
    pub position: DVec3,
    /// The centre of a sphere, and the square of the distance from it beyond which a ray starts far away.
    pub centre: DVec3,
    pub far_away: f64,
    pub size: f64,
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
pub(super) fn interpolate_mesh(hits: &mut HitBlock, maps: &ObjectMaps) {
    for lane in 0..HITS {
        let (origin, corners) = (DVec3::from(at(&hits.origin, lane)), hits.corners_at(lane));
        let is_near = (maps.centre - origin).length_squared() <= maps.far_away;
        let own = maps.object_from_world * (origin - maps.position);
        let direction = maps.object_from_world * DVec3::from(at(&hits.direction, lane));
        let (weights, along, certain) = barycentrics(own.into(), direction.into(), corners);
        set(&mut hits.at, lane, weights);
        let point = maps.world_from_object * DVec3::from(interpolated(weights, corners)) + maps.position;
        set(&mut hits.point, lane, point.into());

        let [a, b, c] = [DVec3::from(corners[0]), DVec3::from(corners[1]), DVec3::from(corners[2])];
        let (one, other) = (b - a, c - a);
        let cross = one.cross(other);
        let is_exact = largest(cross) > largest(one) * largest(other) * EXACT_BELOW;
        let normal = maps.normal_from_object * cross;
        let normal = (normal / largest(normal)).normalize();
        hits.face(lane, normal.into(), !along, maps.size);
        hits.certain[lane] = if certain & is_near & is_exact { 1.0 } else { 0.0 };
    }
}
