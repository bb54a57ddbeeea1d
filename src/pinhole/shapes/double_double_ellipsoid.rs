//! Ellipsoids in double-double: for the few intersections that f64 leaves uncertain.

use super::double_double::{DoubleDouble, add, dot, multiply, negated, smallest_root};
use super::ellipsoid::Ellipsoid;
use super::exact_sum::two_sum;
use glam::DVec3;

/// The smallest t > 0 at which O + tR intersects an ellipsoid, or infinity; computed to about 100 bits, then rounded.
#[cold]
#[inline(never)]
pub fn double_double_ellipsoid_t(origin: DVec3, direction: DVec3, ellipsoid: &Ellipsoid) -> f64 {
    let p = to_unit(ellipsoid, from_centre(origin, ellipsoid));
    let q = to_unit(ellipsoid, direction.to_array().map(|component| (component, 0.0)));
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
    let (from_centre, d) = (from_centre(origin, ellipsoid), direction.to_array().map(|component| (component, 0.0)));
    let at = |t: DoubleDouble| to_unit(ellipsoid, [0, 1, 2].map(|axis| add(from_centre[axis], multiply(t, d[axis]))));
    let (g, q) = (at((t, 0.0)), to_unit(ellipsoid, d));
    let half_chord = discriminant(g, q).max(0.0).sqrt();
    let enters = excess(at((0.0, 0.0))) > 0.0;
    let further = (-dot(g, q).0 + if enters { -half_chord } else { half_chord }) / dot(q, q).0;
    (further, DVec3::from(at(two_sum(t, further)).map(|component| component.0)))
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
    [0, 1, 2].map(|axis| two_sum(origin[axis], -ellipsoid.centre[axis]))
}

/// Transforms a vector from render space to the space where the ellipsoid is the unit sphere.
fn to_unit(ellipsoid: &Ellipsoid, v: [DoubleDouble; 3]) -> [DoubleDouble; 3] {
    let row = |row| ellipsoid.unit_from_world.row(row).to_array().map(|component| (component, 0.0));
    [0, 1, 2].map(|axis| dot(row(axis), v))
}
