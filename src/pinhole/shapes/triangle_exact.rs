//! Ray–triangle intersection in exact arithmetic, for the few cases that f64 leaves uncertain.

use super::exact_sum::{ExactSum, ExactVector, exact_cross, exact_difference, exact_dot};
use super::triangle_row::TriangleRow;
use glam::DVec3;

/// The edge functions of a ray and a triangle, exactly.
struct ExactEdges {
    /// R · (B − O) × (C − O) and its cyclic permutations: the scaled areas opposite each vertex.
    areas: [ExactSum; 3],
    /// Their sum, R · (B − A) × (C − A).
    whole: ExactSum,
    /// The vertices relative to the ray's origin.
    corners: [ExactVector; 3],
}

impl ExactEdges {
    fn of(origin: DVec3, direction: DVec3, triangle: &TriangleRow) -> Self {
        let corners = triangle.corners.map(|corner| exact_difference(corner, origin));
        let direction = exact_difference(direction, DVec3::ZERO);
        let [a, b, c] = &corners;
        let areas = [(b, c), (c, a), (a, b)].map(|(i, j)| exact_dot(&direction, &exact_cross(i, j)));
        let whole = areas[0].plus(&areas[1]).plus(&areas[2]);
        Self { areas, whole, corners }
    }
}

/// The t > 0 at which O + tR hits a triangle, to within a few roundings, or infinity; hit or miss is exact.
///
/// An edge or a vertex belongs to every triangle that has it; a ray in the triangle's plane misses.
#[cold]
#[inline(never)]
pub fn exact_triangle_t(origin: DVec3, direction: DVec3, triangle: &TriangleRow) -> f64 {
    if !(origin.is_finite() && direction.is_finite()) {
        return f64::INFINITY;
    }
    let ExactEdges { areas, whole, corners: [a, b, c] } = ExactEdges::of(origin, direction, triangle);
    let signs = areas.map(|area| area.sign());
    if signs.contains(&1) == signs.contains(&-1) {
        return f64::INFINITY;
    }
    let volume = exact_dot(&a, &exact_cross(&b, &c));
    if volume.sign() * whole.sign() <= 0 { f64::INFINITY } else { volume.rounded() / whole.rounded() }
}

/// The barycentric coordinates of the point where the line O + tR intersects the triangle's plane, to within a few
/// roundings, and R · (B − A) × (C − A), whose sign is exact.
#[cold]
#[inline(never)]
pub fn exact_barycentrics(origin: DVec3, direction: DVec3, triangle: &TriangleRow) -> ([f64; 3], f64) {
    let ExactEdges { areas, whole, .. } = ExactEdges::of(origin, direction, triangle);
    let along = whole.rounded();
    (areas.map(|area| area.rounded() / along), along)
}
