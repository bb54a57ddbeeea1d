use super::{LightPoint, angle_of, pdf_from_area};
use glam::DVec3;

/// A triangle that fills less than this many sr is aimed at by its area: of a thin one no digits are left for its width.
pub(super) const LEAST_SOLID_ANGLE: f64 = 1e-9;

/// A triangle as the lit point sees it: on the unit sphere about that point.
#[derive(Clone, Copy, Debug)]
pub struct TriangleSeen {
    corners: [DVec3; 3],
    cross: DVec3,
    /// The ways to the first two corners.
    first: DVec3,
    second: DVec3,
    /// Across the way to the first corner, towards the third.
    to_third: DVec3,
    /// Cosine and sine of the angle at the first corner.
    alpha: [f64; 2],
    /// The tangent of half the angle from the first corner to the second.
    tan_half: f64,
    /// What the triangle fills, in sr.
    pub solid_angle: f64,
}

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

impl TriangleSeen {
    /// The triangle whose corners are these steps away from the lit point, and which fills so many sr.
    #[inline(always)]
    pub fn new(corners: [DVec3; 3], solid_angle: f64) -> Self {
        let [a, b, c] = corners;
        // By the edges: the cross product of two ways that hardly differ would lose their difference.
        let (across_b, across_c) = (a.cross(b - a), a.cross(c - a));
        let (sine, cosine) = (across_b.cross(across_c).length(), across_b.dot(across_c));
        let whole = (sine * sine + cosine * cosine).sqrt();
        Self {
            corners,
            cross: (b - a).cross(c - a),
            first: a.normalize(),
            second: b.normalize(),
            to_third: across_c.cross(a).normalize_or_zero(),
            alpha: [cosine / whole, sine / whole],
            tan_half: across_b.length() / (a.length() * b.length() + a.dot(b)),
            solid_angle,
        }
    }

    /// The way to a point of the triangle, evenly over its solid angle (Arvo 1995).
    ///
    /// The first number cuts off, with a great circle from b to the edge ac, a triangle that fills that share E: with the
    /// angle α at a, tan(ab/2) tan(ac'/2) sin(α − E/2) = sin(E/2), which loses no digits however small the triangle.
    /// The second picks a point on the cut, where 1 − cos of the way from b is spread evenly.
    #[inline(always)]
    pub fn at(&self, u: [f64; 2]) -> DVec3 {
        let (sine, cosine) = libm::sincos(0.5 * u[0] * self.solid_angle);
        let tan = sine / (self.tan_half * (self.alpha[1] * cosine - self.alpha[0] * sine));
        let tan = if tan >= 0.0 { tan.min(f64::MAX.sqrt()) } else { 0.0 };
        let end = (self.first * (1.0 - tan * tan) + self.to_third * (2.0 * tan)) / (1.0 + tan * tan);
        let versine = u[1] * 0.5 * (end - self.second).length_squared();
        let away = (end - self.second * self.second.dot(end)).normalize_or_zero();
        let direction = self.second * (1.0 - versine) + away * (versine * (2.0 - versine)).max(0.0).sqrt();
        direction * (self.cross.dot(self.corners[0]) / self.cross.dot(direction))
    }
}

/// A point of a triangle: evenly over the directions that it fills, or over its area where it fills hardly any.
#[inline(always)]
pub fn triangle_point(corners: &[DVec3; 3], from: DVec3, u: [f64; 2]) -> LightPoint {
    let there = corners.map(|corner| corner - from);
    let solid_angle = triangle_solid_angle(&there);
    if solid_angle < LEAST_SOLID_ANGLE {
        return triangle_area_point(corners, from, u);
    }
    LightPoint { to: TriangleSeen::new(there, solid_angle).at(u), pdf: 1.0 / solid_angle }
}

/// How likely [`triangle_point`] was to choose a direction, in 1/sr; `to` leads to the triangle's point there.
#[inline(always)]
pub fn triangle_pdf(corners: &[DVec3; 3], from: DVec3, to: DVec3) -> f64 {
    let solid_angle = triangle_solid_angle(&corners.map(|corner| corner - from));
    if solid_angle < LEAST_SOLID_ANGLE { triangle_area_pdf(corners, to) } else { 1.0 / solid_angle }
}

/// A point of a triangle, evenly over its area: √u runs from the first corner to the edge across from it.
#[inline(always)]
pub fn triangle_area_point(corners: &[DVec3; 3], from: DVec3, u: [f64; 2]) -> LightPoint {
    let [a, b, c] = *corners;
    let far = u[0].sqrt();
    let to = (a - from) + ((b - a) * (1.0 - u[1]) + (c - a) * u[1]) * far;
    LightPoint { to, pdf: triangle_area_pdf(corners, to) }
}

/// The density of [`triangle_area_point`], in 1/sr.
#[inline(always)]
pub fn triangle_area_pdf(corners: &[DVec3; 3], to: DVec3) -> f64 {
    let [a, b, c] = *corners;
    let cross = (b - a).cross(c - a);
    let doubled = cross.length();
    pdf_from_area(to, cross / doubled, 0.5 * doubled)
}
