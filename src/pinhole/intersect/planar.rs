//! Where a ray crosses the plane of a planar shape, with an error bound, and the surface there.

use super::Hits;
use super::surface::{Surface, SurfaceSides, SurfaceUvs, Surfaces, l1_norm, offset_bound};
use super::uv::planar_uv;
use crate::extract::{Planar, ShapeTable};
use crate::rays::WorldRays;
use glam::DVec3;

/// 2⁻⁵³, the unit roundoff of f64.
const EPSILON: f64 = 1.0 / (1_u64 << 53) as f64;
/// Half of u: the largest relative error of a t that counts as certain.
const SMALL: f64 = 1.0 / (1_u64 << 25) as f64;

/// The intersection of a ray with the plane of a planar shape, in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The distance along the ray; meaningless if `surely_not`.
    pub t: f64,
    /// The shape's two coordinates of that point.
    pub at: [f64; 2],
    /// A bound on the rounding error of each coordinate.
    pub error: f64,
    /// Whether the ray certainly does not cross the plane at a t > 0.
    pub surely_not: bool,
    /// Whether the relative error of t is less than half of u, so that its sign is certain.
    pub sure: bool,
}

// ANCHOR: crossing
/// Where O + tR crosses the plane n · (x − C) = 0: at t = (n·f) / (n·R) with f = C − O; the coordinates are those of tR
/// − f.
///
/// With ε = 2⁻⁵³, f has a relative error of ε, n·f an error of 4ε Σ|nᵢfᵢ| in all, and n·R one of 2ε Σ|nᵢRᵢ|, because
/// products of 24-bit numbers are exact.
/// The relative error of the quotient is the sum of both relative errors; `relative` is twice that.
/// An error of t moves the point along R; tR − f and the coordinates add an error of 5ε (|tR| + |f|).
#[inline(always)]
pub fn crossing(origin: DVec3, direction: DVec3, planar: &Planar) -> Crossing {
    let f = planar.centre - origin;
    let (of_f, of_direction) = (planar.normal * f, planar.normal * direction);
    let (distance, approach) = (of_f.x + of_f.y + of_f.z, of_direction.x + of_direction.y + of_direction.z);
    let t = distance / approach;
    let along_ray = t * direction;
    let v = along_ray - f;
    let at = [planar.along[0].dot(v), planar.along[1].dot(v)];

    let (sum, sum_of_approach) = (l1_norm(of_f), l1_norm(of_direction));
    let relative = EPSILON * (8.0 * sum / distance.abs() + 4.0 * sum_of_approach / approach.abs() + 2.0);
    let (length, offset) = (l1_norm(along_ray), l1_norm(f));
    let error = 2.0 * planar.norm * (relative * length + 8.0 * EPSILON * (length + offset));
    // Sums of zeros are exact: the ray is parallel to the plane, or starts on it.
    let surely_not = (sum == 0.0) | (sum_of_approach == 0.0) | ((t < 0.0) & (relative < 0.25));
    Crossing { t, at, error, surely_not, sure: relative < SMALL }
}
// ANCHOR_END: crossing

/// Fills the surfaces of the listed rows, all of which hit a planar shape, with their uvs and sides if those are
/// needed.
pub(super) fn fill_planar_surfaces<'f>(
    planar_of: impl Fn(u32) -> &'f Planar,
    shapes: &ShapeTable,
    list: &[u32],
    (rays, hits): (&WorldRays, &Hits),
    surfaces: &mut Surfaces,
    (uvs, sides): (Option<&mut SurfaceUvs>, Option<&mut SurfaceSides>),
) {
    for &row in list {
        let (row, shape) = (row as usize, hits.shape[row as usize]);
        let planar = planar_of(shape);
        let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
        let point = origin + hits.t[row] * direction;
        let bound = offset_bound(point, origin, l1_norm(planar.centre));
        let material = shapes.material[shape as usize];
        surfaces.set(row, Surface::facing(direction, point, planar.normal, bound, material));
    }
    if let Some(sides) = sides {
        for &row in list {
            let row = row as usize;
            let from_above = planar_of(hits.shape[row]).normal.dot(rays.direction_of(row)) <= 0.0;
            sides.outside[row] = u32::from(from_above);
        }
    }
    let Some(uvs) = uvs else { return };
    for &row in list {
        let row = row as usize;
        let at = coordinates(rays.origin_of(row), rays.direction_of(row), hits.t[row], planar_of(hits.shape[row]));
        uvs.set(row, planar_uv(at));
    }
}

/// The two coordinates of O + tR on a planar shape.
#[inline(always)]
fn coordinates(origin: DVec3, direction: DVec3, t: f64, planar: &Planar) -> [f64; 2] {
    let v = t * direction - (planar.centre - origin);
    [planar.along[0].dot(v), planar.along[1].dot(v)]
}
