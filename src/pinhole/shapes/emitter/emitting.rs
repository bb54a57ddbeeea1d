use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
use std::fmt::Debug;

/// How many ways of being sampled a light has at most.
pub const WAYS: usize = 3;
/// The last of them, which finds out what applies; the others are for surfaces of which it is known.
pub const ANY_WAY: usize = WAYS - 1;

/// A shape as a light that is sampled: what sampling its area asks of it.
pub trait Emitting: Clone + Copy + Debug + PartialEq + Send + Sync + 'static {
    /// Whether it encloses a space, so that little of what leaves its inner side is ever seen.
    const IS_CLOSED: bool;
    /// Whether [`Self::point`] is so nearly without branches that it is sampled for many surfaces at once.
    const IN_BLOCKS: bool = false;
    /// Whether [`Self::way`] is not the same everywhere.
    const HAS_WAYS: bool = false;

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

    /// Which of its ways to sample a point applies as seen from `from`; a shape that has several visits them all in
    /// [`Self::in_ways`].
    #[inline(always)]
    fn way(&self, _from: DVec3) -> usize {
        ANY_WAY
    }

    /// [`Self::point`] where the way is known, so that no branch depends on `from`.
    #[inline(always)]
    fn point_in<const WAY: usize>(&self, from: DVec3, u: [f64; 2]) -> LightPoint {
        self.point(from, u)
    }

    /// Calls the visitor with each of its ways.
    #[inline(always)]
    fn in_ways(&self, visitor: &mut impl WayVisitor) {
        visitor.visit::<Self, ANY_WAY>(self);
    }

    /// The pdf with which [`Self::point`] samples the direction to the point `at` of the light, in 1/sr.
    fn pdf(&self, from: DVec3, at: DVec3) -> f64;

    /// The distance to the light along a ray sampled towards it; rounding of the direction may make the ray miss slightly.
    ///
    /// In units of the direction's length.
    fn distance(&self, from: DVec3, direction: DVec3) -> f64;

    /// A point of its area, for a point of the unit square; uniform, or nearly so.
    fn spot(&self, u: [f64; 2]) -> AreaSample;
}

/// What is done in each of the ways in which an emitter is sampled.
pub trait WayVisitor {
    /// In one of them, of which [`Emitting::way`] says where it applies.
    fn visit<E: Emitting, const WAY: usize>(&mut self, emitter: &E);
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

/// tan (π/8).
const EIGHTH: f64 = std::f64::consts::SQRT_2 - 1.0;

/// The angle in [−π, π] with a sine and a cosine in this ratio, within 2 · 2⁻⁵³ of it; 0 where both are 0.
///
/// The lesser over the greater is the tangent of an angle of at most 45°, and with 45° taken off where that leaves less,
/// of at most 22.5°, where the series of the arc tangent needs no more than 22 terms. There is no branch, so that one loop
/// computes the angles of many rows.
#[inline(always)]
pub(super) fn angle_of(sine: f64, cosine: f64) -> f64 {
    let (a, b) = (sine.abs(), cosine.abs());
    let is_steep = a > b;
    let (less, more) = if is_steep { (b, a) } else { (a, b) };
    let is_large = less > EIGHTH * more;
    let (over, under) = if is_large { (less - more, less + more) } else { (less, more) };
    let tangent = if under > 0.0 { over / under } else { under };
    let square = tangent * tangent;
    // Odd and even powers apart are two short chains of operations in place of a long one.
    let [mut even, mut odd] = [0.0; 2];
    let fourth = square * square;
    for pair in (0..11_u32).rev() {
        even = even * fourth + 1.0 / f64::from(4 * pair + 1);
        odd = odd * fourth - 1.0 / f64::from(4 * pair + 3);
    }
    let angle = tangent * (even + square * odd);
    let angle = if is_large { FRAC_PI_4 + angle } else { angle };
    let angle = if is_steep { FRAC_PI_2 - angle } else { angle };
    let angle = if cosine < 0.0 { PI - angle } else { angle };
    if sine < 0.0 { -angle } else { angle }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;

    #[test]
    fn angles_are_those_of_libm() {
        let (mut tried, mut worst) = (0, 0.0_f64);
        let mut beside = |sine: f64, cosine: f64| {
            let (own, expected) = (angle_of(sine, cosine), libm::atan2(sine, cosine));
            if expected != own {
                worst = worst.max((own / expected - 1.0).abs() * (1_u64 << 53) as f64);
            }
            tried += 1;
        };
        for number in 0..200_000 {
            let mut draws = Draws::new(2711, number);
            let vector = draws.unit_vector();
            beside(vector.x, vector.y);
            beside(draws.power_of_ten(-300.0, 0.0), vector.z);
            beside(vector.z, draws.power_of_ten(-300.0, 0.0));
        }
        for ends in
            [[0.0, 1.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0], [0.0, -1.0], [-1.0, -1.0], [-1.0, 0.0], [f64::MAX, 1.0]]
        {
            beside(ends[0], ends[1]);
        }
        eprintln!("angles: {tried}, worst {worst:.2} · 2⁻⁵³ from libm's, relative");
        assert!(worst <= 4.0, "{worst}");
    }
}
