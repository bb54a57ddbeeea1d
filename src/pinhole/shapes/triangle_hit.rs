use super::ray_block::UNIT_ROUNDOFF;
use super::ray_hit::{RayHit, SurfacePoint};
use super::triangle_edges::{Edges, Shear, edges, longest_axis};
use super::triangle_exact::exact_barycentrics;
use super::triangle_row::TriangleRow;
use crate::bvh::by_axis;
use glam::DVec3;

/// The point at which a ray hits a triangle, in barycentric coordinates, and the side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// The barycentric coordinates: each in [0, 1], with a sum of 1 to within 2⁻⁵¹.
    pub weights: [f64; 3],
    /// Whether the ray's direction is on the side of (B − A) × (C − A).
    pub along: bool,
}

impl TriangleHit {
    /// The hit of a ray that is known to hit the triangle.
    #[inline(always)]
    pub fn of(origin: DVec3, direction: DVec3, triangle: &TriangleRow) -> Self {
        match longest_axis(direction) {
            0 => Self::by::<0>(origin, direction, triangle),
            1 => Self::by::<1>(origin, direction, triangle),
            _ => Self::by::<2>(origin, direction, triangle),
        }
    }

    /// The barycentric coordinates are the areas over their sum; those that rounding made negative are set to 0.
    /// If the sum is so small that a coordinate could be off by more than 2⁻²⁶, exact arithmetic is used.
    #[inline(always)]
    fn by<const Z: usize>(origin: DVec3, direction: DVec3, triangle: &TriangleRow) -> Self {
        let (shear, size) = (Shear::along::<Z>(direction), origin.abs().element_sum());
        let Edges { areas, error, .. } = edges::<Z>(origin, shear, triangle, size);
        let whole: f64 = areas.iter().sum();
        let (weights, along) = if 4.0 * error < 0.25 * UNIT_ROUNDOFF * whole.abs() {
            (by_axis(|corner| areas[corner] / whole), whole * shear.z)
        } else {
            exact_barycentrics(origin, direction, triangle)
        };
        let weights = by_axis(|corner| if weights[corner] < 0.0 { 0.0 } else { weights[corner] });
        let sum: f64 = weights.iter().sum();
        Self { weights: by_axis(|corner| weights[corner] / sum), along: along > 0.0 }
    }

    /// Interpolates vectors given at the vertices.
    #[inline(always)]
    pub fn interpolate(&self, vectors: &[DVec3; 3]) -> DVec3 {
        let [a, b, c] = self.weights;
        a * vectors[0] + b * vectors[1] + c * vectors[2]
    }
}

/// The surface where a ray hits a triangle with this normal, which may be turned against the order of its corners.
///
/// The point is interpolated from the vertices rather than computed as O + tR: it is off the plane only by the rounding
/// of that mean, 8ε times the largest vertex, even at grazing incidence, and [`offset_bound`](super::offset_bound) holds as for a plane.
/// For a spawned ray not to hit its own triangle again, the sign of t must also be right (PBRT compares t with its
/// error bound); here that sign is never uncertain.
#[inline(always)]
pub fn triangle_surface(
    triangle: &TriangleRow,
    (side, turned): (DVec3, bool),
    hit: &RayHit,
    triangle_hit: &TriangleHit,
) -> SurfacePoint {
    let point = triangle_hit.interpolate(&triangle.corners);
    let bound = hit.bound(point, triangle.size);
    let outside = triangle_hit.along == turned;
    let normal = if outside { side } else { -side };
    SurfacePoint { point, normal, bound, outside, at: DVec3::from(triangle_hit.weights) }
}
