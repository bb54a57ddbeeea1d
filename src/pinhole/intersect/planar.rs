//! Where a ray crosses the plane of a flat piece, how well f64 knows it, and what the surface is there.

use super::Hits;
use super::surface::{Surface, SurfaceSides, SurfaceUvs, Surfaces, offset_bound, sum_of_parts};
use super::uv::planar_uv;
use crate::extract::{Planar, ShapeTable};
use crate::rays::WorldRays;
use glam::DVec3;

/// 2⁻⁵³, the rounding unit of f64.
const EPSILON: f64 = 1.0 / (1_u64 << 53) as f64;
/// Half of u: no t is given that may be off by more than this, relative to itself.
const SMALL: f64 = 1.0 / (1_u64 << 25) as f64;

/// What f64 says of a ray and the plane of a flat piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Where on the ray; of no meaning where it is surely not ahead.
    pub t: f64,
    /// The two coordinates there.
    pub at: [f64; 2],
    /// How far rounding can have moved a coordinate.
    pub error: f64,
    /// Whether the plane is surely not crossed at a t above 0.
    pub surely_not: bool,
    /// Whether t is good to half of u, relative to itself, and so surely of its sign.
    pub sure: bool,
}

// ANCHOR: crossing
/// Where O + tR crosses the plane n · (x − C) = 0, with f = C − O at t = (n·f) / (n·R), and the coordinates of tR − f there.
///
/// With ε = 2⁻⁵³: f is rounded by ε of itself, n·f by 4ε of Σ|nᵢfᵢ| in all, n·R by 2ε of Σ|nᵢRᵢ|, for the products of
/// numbers of 24 bits are exact.
/// The quotient is off by the sum of both, relative to what was summed; twice that is what `relative` says.
/// An error of t moves the crossing along R; tR − f and the coordinates lose 5ε of |tR| + |f| more.
#[inline(always)]
pub fn crossing(origin: DVec3, direction: DVec3, planar: &Planar) -> Crossing {
    let f = planar.centre - origin;
    let (of_f, of_direction) = (planar.normal * f, planar.normal * direction);
    let (distance, approach) = (of_f.x + of_f.y + of_f.z, of_direction.x + of_direction.y + of_direction.z);
    let t = distance / approach;
    let way = t * direction;
    let v = way - f;
    let at = [planar.along[0].dot(v), planar.along[1].dot(v)];

    let (sum, sum_of_approach) = (sum_of_parts(of_f), sum_of_parts(of_direction));
    let relative = EPSILON * (8.0 * sum / distance.abs() + 4.0 * sum_of_approach / approach.abs() + 2.0);
    let (length, offset) = (sum_of_parts(way), sum_of_parts(f));
    let error = 2.0 * planar.norm * (relative * length + 8.0 * EPSILON * (length + offset));
    // Sums of nothing but 0 are exact: the ray lies along the plane, or starts on it.
    let surely_not = (sum == 0.0) | (sum_of_approach == 0.0) | ((t < 0.0) & (relative < 0.25));
    Crossing { t, at, error, surely_not, sure: relative < SMALL }
}
// ANCHOR_END: crossing

/// Fills the surfaces, and the uvs and sides where they are wanted, of the listed rows, all of which hit a flat piece.
pub(super) fn describe_planar<'f>(
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
        let bound = offset_bound(point, origin, sum_of_parts(planar.centre));
        let material = shapes.material[shape as usize];
        surfaces.set(row, Surface::facing(direction, point, planar.normal, bound, material));
    }
    if let Some(sides) = sides {
        for &row in list {
            let row = row as usize;
            let comes_down = planar_of(hits.shape[row]).normal.dot(rays.direction_of(row)) <= 0.0;
            sides.outside[row] = u32::from(comes_down);
        }
    }
    let Some(uvs) = uvs else { return };
    for &row in list {
        let row = row as usize;
        let at = coordinates(rays.origin_of(row), rays.direction_of(row), hits.t[row], planar_of(hits.shape[row]));
        uvs.set(row, planar_uv(at));
    }
}

/// The two coordinates of O + tR in a flat piece.
#[inline(always)]
fn coordinates(origin: DVec3, direction: DVec3, t: f64, planar: &Planar) -> [f64; 2] {
    let v = t * direction - (planar.centre - origin);
    [planar.along[0].dot(v), planar.along[1].dot(v)]
}
