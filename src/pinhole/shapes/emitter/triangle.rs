use super::emitting::{AreaSample, Emitting, LightPoint, angle_of, pdf_from_area};
use crate::each::Each;
use crate::sample::circle_point;
use crate::shapes::l1_norm;
use glam::DVec3;
use std::f64::consts::PI;

/// A triangle that subtends less than this many sr is sampled by area, since the width of a thin one would have no
/// digits left.
pub(super) const MIN_SOLID_ANGLE: f64 = 1e-9;

/// Beyond this its square would be infinite.
const MAX_TAN: f64 = 1e154;

/// A vector divided by its length; 0 where it has none.
#[inline(always)]
fn unit_or_zero(vector: DVec3) -> DVec3 {
    let inverse = 1.0 / vector.length();
    vector * if (inverse > 0.0) & (inverse < f64::INFINITY) { inverse } else { 0.0 }
}

/// A triangle as a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmittingTriangle {
    /// Relative to the eye.
    pub corners: [DVec3; 3],
    /// The unit normal on its own side.
    pub normal: DVec3,
}

/// 2⁻⁵⁰: eight times f64's unit roundoff, of which the height of a point above a triangle's plane needs six.
const HEIGHT_ERROR: f64 = 1.0 / (1_u64 << 50) as f64;

impl Emitting for EmittingTriangle {
    const IS_CLOSED: bool = false;
    const IN_BLOCKS: bool = true;

    fn area(&self) -> f64 {
        let [a, b, c] = self.corners;
        0.5 * (b - a).cross(c - a).length()
    }

    #[inline(always)]
    fn faces(&self, point: DVec3) -> bool {
        self.normal.dot(point - self.corners[0]) > 0.0
    }

    fn plane_normal(&self) -> Option<DVec3> {
        Some(self.normal)
    }

    #[inline(always)]
    fn point(&self, from: DVec3, u: [f64; 2]) -> LightPoint {
        triangle_point(&self.corners, from, u)
    }

    #[inline(always)]
    fn pdf(&self, from: DVec3, at: DVec3) -> f64 {
        triangle_pdf(&self.corners, from, at - from)
    }

    #[inline(always)]
    fn distance(&self, from: DVec3, direction: DVec3) -> f64 {
        let [corner, ..] = self.corners;
        let slope = self.normal.dot(direction);
        let (t, error) =
            (self.normal.dot(corner - from) / slope, HEIGHT_ERROR * (l1_norm(corner) + l1_norm(from)) / slope);
        // Less by what rounding may do, such that another triangle of the same plane does not hide this one.
        t - error.abs()
    }

    #[inline(always)]
    fn spot(&self, u: [f64; 2]) -> AreaSample {
        let [a, b, c] = self.corners;
        let root = u[0].sqrt();
        let position = a * (1.0 - root) + b * (root * (1.0 - u[1])) + c * (root * u[1]);
        let size = self.corners.into_iter().map(l1_norm).fold(0.0, f64::max);
        AreaSample { position, normal: self.normal, area: self.area(), size }
    }
}

/// A triangle as seen from the lit point: projected on the unit sphere about that point.
#[derive(Clone, Copy, Debug)]
pub struct TriangleSeen {
    corners: [DVec3; 3],
    cross: DVec3,
    /// The directions to the first two corners.
    first: DVec3,
    second: DVec3,
    /// Perpendicular to the direction to the first corner, towards the third.
    to_third: DVec3,
    /// Cosine and sine of the angle at the first corner.
    alpha: [f64; 2],
    /// The tangent of half the angle from the first corner to the second.
    tan_half: f64,
    /// Its solid angle, in sr.
    pub solid_angle: f64,
}

/// The solid angle of the triangle with corners at these offsets (Van Oosterom and Strackee 1983).
///
/// For unit vectors a, b, c its half has the tangent |a · (b × c)| / (1 + a · b + b · c + c · a).
#[inline(always)]
pub fn triangle_solid_angle(corners: &[DVec3; 3]) -> f64 {
    let [a, b, c] = *corners;
    let [la, lb, lc] = corners.each(|corner| corner.length());
    // From the edges, whose cross product keeps the area of a distant triangle.
    let volume = a.dot((b - a).cross(c - a)).abs();
    let rest = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * angle_of(volume, rest)
}

impl TriangleSeen {
    /// The triangle with corners at these offsets from the lit point, and its solid angle in sr.
    #[inline(always)]
    pub fn new(corners: [DVec3; 3], solid_angle: f64) -> Self {
        let [a, b, c] = corners;
        // From the edges: the cross product of two nearly equal offsets would lose their difference.
        let (across_b, across_c) = (a.cross(b - a), a.cross(c - a));
        let (sine, cosine) = (across_b.cross(across_c).length(), across_b.dot(across_c));
        let inverse = 1.0 / (sine * sine + cosine * cosine).sqrt();
        let (length_a, length_b) = (a.length(), b.length());
        Self {
            corners,
            cross: (b - a).cross(c - a),
            first: a * (1.0 / length_a),
            second: b * (1.0 / length_b),
            to_third: unit_or_zero(across_c.cross(a)),
            alpha: [cosine * inverse, sine * inverse],
            tan_half: across_b.length() / (length_a * length_b + a.dot(b)),
            solid_angle,
        }
    }

    /// The offset to a point of the triangle, uniform in solid angle (Arvo 1995).
    ///
    /// The first number cuts off a subtriangle of that fraction of the solid angle, E, by a great circle from b to the
    /// edge ac: with the angle α at a, tan(ab/2) tan(ac'/2) sin(α − E/2) = sin(E/2), which loses no digits however
    /// small the triangle.
    /// The second selects a point on that circle, where 1 − cos of the angle from b is uniform.
    #[inline(always)]
    pub fn at(&self, u: [f64; 2]) -> DVec3 {
        let [cosine, sine] = circle_point(u[0] * self.solid_angle * (0.25 / PI));
        let tan = sine / (self.tan_half * (self.alpha[1] * cosine - self.alpha[0] * sine));
        let tan = if tan >= 0.0 { if tan < MAX_TAN { tan } else { MAX_TAN } } else { 0.0 };
        let end = (self.first * (1.0 - tan * tan) + self.to_third * (2.0 * tan)) * (1.0 / (1.0 + tan * tan));
        let versine = u[1] * 0.5 * (end - self.second).length_squared();
        let away = unit_or_zero(end - self.second * self.second.dot(end));
        let squared = versine * (2.0 - versine);
        let direction = self.second * (1.0 - versine) + away * if squared > 0.0 { squared } else { 0.0 }.sqrt();
        direction * (self.cross.dot(self.corners[0]) / self.cross.dot(direction))
    }
}

/// Samples a point on a triangle: uniform in solid angle, or over its area where it subtends hardly any.
#[inline(always)]
pub fn triangle_point(corners: &[DVec3; 3], from: DVec3, u: [f64; 2]) -> LightPoint {
    let there = corners.each(|corner| corner - from);
    let solid_angle = triangle_solid_angle(&there);
    // Both are computed and one is picked, so that a loop over many surfaces has no branch.
    let (by_area, seen) = (triangle_area_point(corners, from, u), TriangleSeen::new(there, solid_angle).at(u));
    let pick = |small: f64, large: f64| if solid_angle < MIN_SOLID_ANGLE { small } else { large };
    let to = DVec3::new(pick(by_area.to.x, seen.x), pick(by_area.to.y, seen.y), pick(by_area.to.z, seen.z));
    LightPoint { to, pdf: pick(by_area.pdf, 1.0 / solid_angle) }
}

/// The pdf of a direction sampled by [`triangle_point`], in 1/sr; `to` is the offset to the triangle's point there.
#[inline(always)]
pub fn triangle_pdf(corners: &[DVec3; 3], from: DVec3, to: DVec3) -> f64 {
    let solid_angle = triangle_solid_angle(&corners.each(|corner| corner - from));
    if solid_angle < MIN_SOLID_ANGLE { triangle_area_pdf(corners, to) } else { 1.0 / solid_angle }
}

/// Samples a point uniformly over a triangle's area: √u runs from the first corner to the opposite edge.
#[inline(always)]
pub fn triangle_area_point(corners: &[DVec3; 3], from: DVec3, u: [f64; 2]) -> LightPoint {
    let [a, b, c] = *corners;
    let far = u[0].sqrt();
    let to = (a - from) + ((b - a) * (1.0 - u[1]) + (c - a) * u[1]) * far;
    LightPoint { to, pdf: triangle_area_pdf(corners, to) }
}

/// The pdf of [`triangle_area_point`], in 1/sr.
#[inline(always)]
pub fn triangle_area_pdf(corners: &[DVec3; 3], to: DVec3) -> f64 {
    let [a, b, c] = *corners;
    let cross = (b - a).cross(c - a);
    let doubled = cross.length();
    pdf_from_area(to, cross / doubled, 0.5 * doubled)
}
