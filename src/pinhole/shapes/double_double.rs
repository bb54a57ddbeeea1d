//! Double-double arithmetic, with about 106 bits: for the few intersections that f64 leaves uncertain.
//!
//! It does not use fused multiply-add, so every machine gives the same bits.

use super::exact_sum::{two_product, two_sum};
use glam::DVec3;

/// A double-double: a number as the unevaluated sum of two f64.
pub(super) type DoubleDouble = (f64, f64);

// ANCHOR: double_double_sphere_t
/// The smallest t > 0 at which O + tR intersects a sphere, or infinity; computed to about 100 bits, then rounded.
///
/// With that many bits the textbook quadratic formula is good enough.
#[cold]
#[inline(never)]
pub fn double_double_sphere_t(origin: DVec3, direction: DVec3, centre: DVec3, radius: f64) -> f64 {
    let d = direction.to_array().map(|component| (component, 0.0));
    let f = [0, 1, 2].map(|axis| two_sum(centre[axis], -origin[axis]));
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
    [0, 1, 2].map(|axis| two_sum(centre[axis], -origin[axis]))
}

pub(super) fn exact(v: DVec3) -> [DoubleDouble; 3] {
    v.to_array().map(|component| (component, 0.0))
}
