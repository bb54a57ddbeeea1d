use super::{LightPoint, angle_of, density_from_area};
use glam::DVec3;

/// A triangle that fills less than this many sr is aimed at by its area.
///
/// Below it the cosine that the method solves for keeps too few digits: at 10⁻⁴ sr the point is good to 10⁻⁸ of an edge.
const LEAST_SOLID_ANGLE: f64 = 1e-4;

/// A triangle as the lit point sees it: on the unit sphere about that point.
#[derive(Clone, Copy, Debug)]
pub struct TriangleSeen {
    corners: [DVec3; 3],
    cross: DVec3,
    on_sphere: [DVec3; 3],
    /// The angle at the first corner.
    alpha: f64,
    /// What the triangle fills, in sr.
    pub solid_angle: f64,
}

// ANCHOR: triangle_solid_angle
/// The solid angle of the triangle whose corners are these steps away (Van Oosterom and Strackee 1983).
///
/// With unit vectors a, b, c its half has the tangent |a · (b × c)| / (1 + a · b + b · c + c · a).
#[inline(always)]
pub fn triangle_solid_angle(corners: &[DVec3; 3]) -> f64 {
    let [a, b, c] = *corners;
    let [la, lb, lc] = corners.map(|corner| corner.length());
    // By the edges, whose cross product does not lose the area of a triangle far away.
    let volume = a.dot((b - a).cross(c - a)).abs();
    let rest = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * angle_of(volume, rest)
}
// ANCHOR_END: triangle_solid_angle

impl TriangleSeen {
    /// The triangle whose corners are these steps away from the lit point.
    #[inline(always)]
    pub fn new(corners: [DVec3; 3]) -> Self {
        let on_sphere = corners.map(|corner| corner / corner.length());
        let [a, b, c] = on_sphere;
        let (ab, ca) = (a.cross(b), c.cross(a));
        let alpha = angle_of(ab.cross(ca).length(), -ab.dot(ca));
        let cross = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        Self { corners, cross, on_sphere, alpha, solid_angle: triangle_solid_angle(&corners) }
    }

    // ANCHOR: triangle_at
    /// The way to a point of the triangle, evenly over its solid angle (Arvo 1995).
    ///
    /// The first number cuts off, with a great circle from b to the edge ac, a triangle that fills that share; the second
    /// picks a point on the cut, where 1 − cos of the way from b is spread evenly.
    #[inline(always)]
    pub fn at(&self, u: [f64; 2]) -> DVec3 {
        let [a, b, c] = self.on_sphere;
        let (sin_alpha, cos_alpha) = (libm::sin(self.alpha), libm::cos(self.alpha));
        let phi = u[0] * self.solid_angle - self.alpha;
        let (s, t) = (libm::sin(phi), libm::cos(phi));
        let (p, q) = (t - cos_alpha, s + sin_alpha * a.dot(b));
        let cut = ((q * t - p * s) * cos_alpha - q) / ((q * s + p * t) * sin_alpha);
        let cut = if cut.is_nan() { 1.0 } else { cut.clamp(a.dot(c).min(1.0), 1.0) };
        let away = (c - a * a.dot(c)).try_normalize().unwrap_or(DVec3::ZERO);
        let end = (a * cut + away * (1.0 - cut * cut).max(0.0).sqrt()).normalize();
        let versine = u[1] * 0.5 * (end - b).length_squared();
        let away = (end - b * b.dot(end)).try_normalize().unwrap_or(DVec3::ZERO);
        let direction = b * (1.0 - versine) + away * (versine * (2.0 - versine)).max(0.0).sqrt();
        direction * (self.cross.dot(self.corners[0]) / self.cross.dot(direction))
    }
    // ANCHOR_END: triangle_at
}

/// A point of a triangle: evenly over the directions that it fills, or over its area where it fills hardly any.
#[inline(always)]
pub fn triangle_point(corners: &[DVec3; 3], from: DVec3, u: [f64; 2]) -> LightPoint {
    let there = corners.map(|corner| corner - from);
    if triangle_solid_angle(&there) < LEAST_SOLID_ANGLE {
        return triangle_area_point(corners, from, u);
    }
    let seen = TriangleSeen::new(there);
    LightPoint { to: seen.at(u), density: 1.0 / seen.solid_angle }
}

/// How likely [`triangle_point`] was to choose a direction, in 1/sr; `to` leads to the triangle's point there.
#[inline(always)]
pub fn triangle_density(corners: &[DVec3; 3], from: DVec3, to: DVec3) -> f64 {
    let solid_angle = triangle_solid_angle(&corners.map(|corner| corner - from));
    if solid_angle < LEAST_SOLID_ANGLE { triangle_area_density(corners, to) } else { 1.0 / solid_angle }
}

/// A point of a triangle, evenly over its area: √u runs from the first corner to the edge across from it.
#[inline(always)]
pub fn triangle_area_point(corners: &[DVec3; 3], from: DVec3, u: [f64; 2]) -> LightPoint {
    let [a, b, c] = *corners;
    let far = u[0].sqrt();
    let to = (a - from) + ((b - a) * (1.0 - u[1]) + (c - a) * u[1]) * far;
    LightPoint { to, density: triangle_area_density(corners, to) }
}

/// The density of [`triangle_area_point`], in 1/sr.
#[inline(always)]
pub fn triangle_area_density(corners: &[DVec3; 3], to: DVec3) -> f64 {
    let [a, b, c] = *corners;
    let cross = (b - a).cross(c - a);
    let doubled = cross.length();
    density_from_area(to, cross / doubled, 0.5 * doubled)
}
