//! Double-double arithmetic, with about 106 bits, and the few intersections in it that f64 leaves uncertain.
//!
//! It does not use fused multiply-add, so every machine gives the same bits.

use super::arithmetic::{two_product, two_sum};
use super::cuboid::Slabs;
use super::ellipsoid::Ellipsoid;
use super::planar::Planar;
use glam::DVec3;

use crate::each::Each;

/// A double-double: a number as the unevaluated sum of two f64.
pub(super) type DoubleDouble = (f64, f64);

// ANCHOR: double_double_sphere_t
/// The smallest t > 0 at which O + tR intersects a sphere, or infinity; computed to about 100 bits, then rounded.
///
/// With that many bits the textbook quadratic formula is good enough.
#[cold]
#[inline(never)]
pub fn double_double_sphere_t(origin: DVec3, direction: DVec3, centre: DVec3, radius: f64) -> f64 {
    let d = direction.to_array().each(|component| (component, 0.0));
    let f = [0, 1, 2].each(|axis| two_sum(centre[axis], -origin[axis]));
    let (a, b) = (dot(d, d), dot(f, d));
    let c = add(dot(f, f), negated(two_product(radius, radius)));
    smallest_root(a.0, b.0, c.0, add(multiply(b, b), negated(multiply(a, c))).0)
}
// ANCHOR_END: double_double_sphere_t

/// The smallest t > 0 with at² − 2bt + c = 0, or infinity; the discriminant is b² − ac.
pub(super) fn smallest_root(a: f64, b: f64, c: f64, discriminant: f64) -> f64 {
    if discriminant < 0.0 {
        return f64::INFINITY;
    }
    let larger = b + discriminant.sqrt().copysign(b);
    let (outer, inner) = (larger / a, c / larger);
    let (near, far) = (outer.min(inner), outer.max(inner));
    if near > 0.0 {
        near
    } else if far > 0.0 {
        far
    } else {
        f64::INFINITY
    }
}

pub(super) fn add(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble {
    let (sum, error) = two_sum(a.0, b.0);
    let (low, lower) = two_sum(a.1, b.1);
    let (sum, error) = two_sum(sum, error + low);
    two_sum(sum, error + lower)
}

pub(super) fn multiply(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble {
    let (product, error) = two_product(a.0, b.0);
    two_sum(product, error + (a.0 * b.1 + a.1 * b.0))
}

pub(super) fn negated(a: DoubleDouble) -> DoubleDouble {
    (-a.0, -a.1)
}

pub(super) fn dot(a: [DoubleDouble; 3], b: [DoubleDouble; 3]) -> DoubleDouble {
    add(add(multiply(a[0], b[0]), multiply(a[1], b[1])), multiply(a[2], b[2]))
}

/// C − O, exactly.
pub(super) fn offset(origin: DVec3, centre: DVec3) -> [DoubleDouble; 3] {
    [0, 1, 2].each(|axis| two_sum(centre[axis], -origin[axis]))
}

pub(super) fn exact(v: DVec3) -> [DoubleDouble; 3] {
    v.to_array().each(|component| (component, 0.0))
}

// Ellipsoids in double-double: for the few intersections that f64 leaves uncertain.

/// The smallest t > 0 at which O + tR intersects an ellipsoid, or infinity; computed to about 100 bits, then rounded.
#[cold]
#[inline(never)]
pub fn double_double_ellipsoid_t(origin: DVec3, direction: DVec3, ellipsoid: &Ellipsoid) -> f64 {
    let p = to_unit(ellipsoid, from_centre(origin, ellipsoid));
    let q = to_unit(ellipsoid, direction.to_array().each(|component| (component, 0.0)));
    let (a, b, c) = (dot(q, q), dot(p, q), excess(p));
    smallest_root(a.0, -b.0, c, discriminant(p, q))
}

/// The correction to t that leads to the ellipsoid to the last bits, and the hit point in the space where the ellipsoid
/// is the unit sphere.
///
/// From afar the spacing of t can exceed the chord through the ellipsoid, so the ray's closest point to the centre is
/// computed relative to t, and half the chord is subtracted for the entry or added for the exit.
#[cold]
#[inline(never)]
pub fn double_double_ellipsoid_point(origin: DVec3, direction: DVec3, t: f64, ellipsoid: &Ellipsoid) -> (f64, DVec3) {
    let (from_centre, d) = (from_centre(origin, ellipsoid), direction.to_array().each(|component| (component, 0.0)));
    let at = |t: DoubleDouble| to_unit(ellipsoid, [0, 1, 2].each(|axis| add(from_centre[axis], multiply(t, d[axis]))));
    let (g, q) = (at((t, 0.0)), to_unit(ellipsoid, d));
    let half_chord = discriminant(g, q).max(0.0).sqrt();
    let enters = excess(at((0.0, 0.0))) > 0.0;
    let further = (-dot(g, q).0 + if enters { -half_chord } else { half_chord }) / dot(q, q).0;
    (further, DVec3::from(at(two_sum(t, further)).each(|component| component.0)))
}

/// |p|² − 1.
fn excess(p: [DoubleDouble; 3]) -> f64 {
    add(dot(p, p), (-1.0, 0.0)).0
}

/// (p·q)² − q·q (p·p − 1), computed as q·q − |p × q|², which has the same value at every point of the ray and cancels
/// only as far as the ray is close to tangent.
fn discriminant(p: [DoubleDouble; 3], q: [DoubleDouble; 3]) -> f64 {
    let area = |i: usize, j: usize| add(multiply(p[i], q[j]), negated(multiply(p[j], q[i])));
    let across = [area(1, 2), area(2, 0), area(0, 1)];
    add(dot(q, q), negated(dot(across, across))).0
}

/// O − C, exactly.
fn from_centre(origin: DVec3, ellipsoid: &Ellipsoid) -> [DoubleDouble; 3] {
    [0, 1, 2].each(|axis| two_sum(origin[axis], -ellipsoid.centre[axis]))
}

/// Transforms a vector from render space to the space where the ellipsoid is the unit sphere.
fn to_unit(ellipsoid: &Ellipsoid, v: [DoubleDouble; 3]) -> [DoubleDouble; 3] {
    let row = |row| ellipsoid.unit_from_world.row(row).to_array().each(|component| (component, 0.0));
    [0, 1, 2].each(|axis| dot(row(axis), v))
}

// Planar shapes and slabs in double-double: for the few intersections that f64 leaves uncertain.

/// Where a ray crosses the plane of a planar shape: t is `distance` / `approach`, and the coordinates are `at` /
/// `approach`.
struct DoubleDoubleCrossing {
    distance: DoubleDouble,
    approach: DoubleDouble,
    at: [DoubleDouble; 2],
}

impl DoubleDoubleCrossing {
    fn of(origin: DVec3, direction: DVec3, planar: &Planar) -> Self {
        let (f, d, n) = (offset(origin, planar.centre), exact(direction), exact(planar.normal));
        let (distance, approach) = (dot(n, f), dot(n, d));
        let scaled = [0, 1, 2].each(|axis| add(multiply(d[axis], distance), negated(multiply(f[axis], approach))));
        Self { distance, approach, at: planar.along.each(|along| dot(exact(along), scaled)) }
    }

    /// t if it is positive and the point is inside the shape, or infinity.
    fn t_if(&self, inside: bool) -> f64 {
        let t = self.distance.0 / self.approach.0;
        if inside && t > 0.0 && t < f64::INFINITY { t } else { f64::INFINITY }
    }
}

/// The t > 0 at which O + tR hits a disk, or infinity; computed to about 100 bits, then rounded.
#[cold]
#[inline(never)]
pub fn double_double_disk_t(origin: DVec3, direction: DVec3, planar: &Planar) -> f64 {
    let crossing = DoubleDoubleCrossing::of(origin, direction, planar);
    let [x, z] = crossing.at.each(|coordinate| multiply(coordinate, coordinate));
    let beyond = add(add(x, z), negated(multiply(crossing.approach, crossing.approach)));
    crossing.t_if(beyond.0 <= 0.0)
}

/// The t > 0 at which O + tR hits a rectangle, or infinity; computed to about 100 bits, then rounded.
#[cold]
#[inline(never)]
pub fn double_double_rectangle_t(origin: DVec3, direction: DVec3, planar: &Planar) -> f64 {
    let crossing = DoubleDoubleCrossing::of(origin, direction, planar);
    let max = magnitude(crossing.approach);
    crossing.t_if(crossing.at.iter().all(|&coordinate| add(magnitude(coordinate), negated(max)).0 <= 0.0))
}

/// A t as a quotient with positive denominator, and the axis of the face there.
#[derive(Clone, Copy)]
struct Fraction {
    numerator: DoubleDouble,
    denominator: DoubleDouble,
    axis: usize,
}

impl Fraction {
    /// A number with the sign of the difference to another t.
    fn minus(&self, other: &Self) -> f64 {
        add(multiply(self.numerator, other.denominator), negated(multiply(other.numerator, self.denominator))).0
    }

    fn t(&self) -> f64 {
        self.numerator.0 / self.denominator.0
    }
}

/// The smallest t > 0 at which O + tR intersects a face of a cuboid, or infinity, computed to about 100 bits, then
/// rounded; and the axis of that face.
///
/// At an edge or a vertex it is the first of the axes.
#[cold]
#[inline(never)]
pub fn double_double_cuboid_t(origin: DVec3, direction: DVec3, slabs: &Slabs) -> (f64, usize) {
    const MISS: (f64, usize) = (f64::INFINITY, 0);
    let (f, d) = (offset(origin, slabs.centre), exact(direction));
    let (mut enters, mut leaves): (Option<Fraction>, Option<Fraction>) = (None, None);
    for axis in 0..3 {
        let n = exact(slabs.normal[axis]);
        let (mut middle, mut approach, half) = (dot(n, f), dot(n, d), (slabs.half[axis], 0.0));
        if approach.0 < 0.0 {
            (middle, approach) = (negated(middle), negated(approach));
        }
        let (near, far) = (add(middle, negated(half)), add(middle, half));
        if approach.0 == 0.0 {
            if near.0 > 0.0 || far.0 < 0.0 {
                return MISS;
            }
            continue;
        }
        let (near, far) = (
            Fraction { numerator: near, denominator: approach, axis },
            Fraction { numerator: far, denominator: approach, axis },
        );
        enters = Some(enters.filter(|enters| near.minus(enters) <= 0.0).unwrap_or(near));
        leaves = Some(leaves.filter(|leaves| far.minus(leaves) >= 0.0).unwrap_or(far));
    }
    let (Some(enters), Some(leaves)) = (enters, leaves) else { return MISS };
    let found = if enters.numerator.0 > 0.0 { enters } else { leaves };
    let t = found.t();
    if enters.minus(&leaves) <= 0.0 && t > 0.0 && t < f64::INFINITY { (t, found.axis) } else { MISS }
}

fn magnitude(a: DoubleDouble) -> DoubleDouble {
    if a.0 < 0.0 { negated(a) } else { a }
}
