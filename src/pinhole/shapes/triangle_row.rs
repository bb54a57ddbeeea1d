use super::exact_sum::{exact_cross, exact_difference};
use glam::DVec3;

/// The factor by which a triangle's bounding sphere is enlarged, so that no rounding leads outside it.
const RADIUS_MARGIN: f64 = 1.0 + 1.0 / 65_536.0;

/// A triangle as the intersection kernels read it.
///
/// Its corners are sorted, whatever the author's order, so that the same three corners give every ray the same distance
/// to the last bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleRow {
    /// The corners, relative to the eye.
    pub corners: [DVec3; 3],
    /// The largest |x| + |y| + |z| of a corner.
    pub size: f64,
    /// The midpoint of the longest edge.
    pub centre: DVec3,
    /// The radius of a bounding sphere about the centre.
    pub bounding_radius: f64,
}

impl TriangleRow {
    /// The triangle of three corners.
    pub fn new(mut corners: [DVec3; 3]) -> Self {
        corners.sort_by(order);
        let size = corners.map(|corner| corner.abs().element_sum()).into_iter().fold(0.0, f64::max);
        let edges = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| (corners[i], corners[j]));
        let longest = edges.into_iter().max_by(|a, b| a.0.distance(a.1).total_cmp(&b.0.distance(b.1)));
        let centre = longest.map_or(corners[0], |(a, b)| a.midpoint(b));
        let bounding_radius =
            corners.map(|corner| corner.distance(centre)).into_iter().fold(0.0, f64::max) * RADIUS_MARGIN;
        Self { corners, size, centre, bounding_radius }
    }

    /// (B − A) × (C − A), each component accurate to within two roundings however thin the triangle; all 0 for
    /// collinear corners.
    pub fn cross(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        DVec3::from(exact_cross(&exact_difference(b, a), &exact_difference(c, a)).map(|part| part.rounded()))
    }
}

/// The order of corners: by x, then y, then z.
pub(super) fn order(a: &DVec3, b: &DVec3) -> std::cmp::Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
}
