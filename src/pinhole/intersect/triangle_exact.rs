//! Rays and triangles without any rounding, for the few that f64 leaves in doubt.

use crate::extract::{ExactSum, ExactVector, TriangleRow, exact_cross, exact_difference, exact_dot};
use glam::DVec3;

/// A ray and a triangle, exactly.
struct ExactEdges {
    /// R · (B − O) × (C − O) and so on: the areas that the ray's point cuts off opposite each corner.
    areas: [ExactSum; 3],
    /// Their sum, R · (B − A) × (C − A).
    whole: ExactSum,
    /// The corners from the ray's origin.
    corners: [ExactVector; 3],
}

impl ExactEdges {
    fn of(origin: DVec3, direction: DVec3, facet: &TriangleRow) -> Self {
        let corners = facet.corners.map(|corner| exact_difference(corner, origin));
        let direction = exact_difference(direction, DVec3::ZERO);
        let [a, b, c] = &corners;
        let areas = [(b, c), (c, a), (a, b)].map(|(i, j)| exact_dot(&direction, &exact_cross(i, j)));
        let whole = areas[0].plus(&areas[1]).plus(&areas[2]);
        Self { areas, whole, corners }
    }
}

/// The t > 0 at which O + tR meets a triangle, to within a few roundings, or infinity; whether it does is exact.
///
/// An edge and a corner belong to every triangle that has them; a ray in the triangle's plane meets nothing.
#[cold]
#[inline(never)]
pub fn exact_triangle_t(origin: DVec3, direction: DVec3, facet: &TriangleRow) -> f64 {
    if !(origin.is_finite() && direction.is_finite()) {
        return f64::INFINITY;
    }
    let ExactEdges { areas, whole, corners: [a, b, c] } = ExactEdges::of(origin, direction, facet);
    let signs = areas.map(|area| area.sign());
    if signs.contains(&1) == signs.contains(&-1) {
        return f64::INFINITY;
    }
    let volume = exact_dot(&a, &exact_cross(&b, &c));
    if volume.sign() * whole.sign() <= 0 { f64::INFINITY } else { volume.rounded() / whole.rounded() }
}

/// The corners' shares of the point where the line O + tR meets the triangle's plane, to within a few roundings, and the
/// sign of R · (B − A) × (C − A), exactly.
#[cold]
#[inline(never)]
pub fn exact_weights(origin: DVec3, direction: DVec3, facet: &TriangleRow) -> ([f64; 3], f64) {
    let ExactEdges { areas, whole, .. } = ExactEdges::of(origin, direction, facet);
    let along = whole.rounded();
    (areas.map(|area| area.rounded() / along), along)
}
