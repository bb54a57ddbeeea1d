use glam::DVec3;
use std::fmt::Debug;

/// A shape as a light that is sampled: what sampling its area asks of it.
pub trait Emitting: Clone + Copy + Debug + PartialEq + Send + Sync + 'static {
    /// Whether it encloses a space, so that little of what leaves its inner side is ever seen.
    const IS_CLOSED: bool;

    /// The area that emits, on one side, in square scene units.
    fn area(&self) -> f64;

    /// Whether a point is on the side of the shape's own normal, which is the outside of a closed shape.
    fn faces(&self, point: DVec3) -> bool;

    /// The unit normal on its own side where all of it is in one plane; none for other shapes.
    fn plane_normal(&self) -> Option<DVec3> {
        None
    }

    /// The point of the light for a point of the unit square, as seen from `from`.
    fn point(&self, from: DVec3, u: [f64; 2]) -> LightPoint;

    /// The pdf with which [`Self::point`] samples the direction to the point `at` of the light, in 1/sr.
    fn pdf(&self, from: DVec3, at: DVec3) -> f64;

    /// The distance to the light along a ray sampled towards it; rounding of the direction may make the ray miss slightly.
    ///
    /// In units of the direction's length.
    fn distance(&self, from: DVec3, direction: DVec3) -> f64;

    /// A point of its area, for a point of the unit square; uniform, or nearly so.
    fn spot(&self, u: [f64; 2]) -> AreaSample;
}

/// A point sampled on a light, as seen from the lit point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightPoint {
    /// The offset from the lit point, in scene units.
    pub to: DVec3,
    /// Its pdf in 1/sr; 0 where the light is seen edge-on.
    pub pdf: f64,
}

impl LightPoint {
    /// No point, for a light seen edge-on.
    pub const NONE: Self = Self { to: DVec3::ZERO, pdf: 0.0 };
}

/// A point of a light from which a ray leaves it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaSample {
    /// The position in render space.
    pub position: DVec3,
    /// The unit normal of the shape's own side.
    pub normal: DVec3,
    /// 1 over its pdf per unit of area, in square scene units: all of the area where points are uniform.
    pub area: f64,
    /// The largest magnitude in the computation of its position, for its error bound.
    pub size: f64,
}

/// The emitter of shapes whose area is infinite or has no known sampling: there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NeverSampled {}

impl Emitting for NeverSampled {
    const IS_CLOSED: bool = false;

    fn area(&self) -> f64 {
        match *self {}
    }

    fn faces(&self, _: DVec3) -> bool {
        match *self {}
    }

    fn point(&self, _: DVec3, _: [f64; 2]) -> LightPoint {
        match *self {}
    }

    fn pdf(&self, _: DVec3, _: DVec3) -> f64 {
        match *self {}
    }

    fn distance(&self, _: DVec3, _: DVec3) -> f64 {
        match *self {}
    }

    fn spot(&self, _: [f64; 2]) -> AreaSample {
        match *self {}
    }
}

// ANCHOR: pdf_from_area
/// The pdf per unit of solid angle of a point uniform over a planar area: d² / (A cos θ), with θ at the light.
///
/// 0 where the area is seen edge-on, since it subtends no solid angle.
#[inline(always)]
pub fn pdf_from_area(to: DVec3, unit_normal: DVec3, area: f64) -> f64 {
    // Not yet divided by d.
    let cosine = unit_normal.dot(to).abs();
    if cosine > 0.0 { to.length_squared() * to.length() / (area * cosine) } else { 0.0 }
}
// ANCHOR_END: pdf_from_area

/// The angle in [0, π] with a sine and a cosine in this ratio.
#[inline(always)]
pub(super) fn angle_of(sine: f64, cosine: f64) -> f64 {
    libm::atan2(sine, cosine)
}
