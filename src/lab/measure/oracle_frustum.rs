//! The exact oracle of a ray against a cylinder or a cone, with or without caps.
//!
//! Reads: the f32 ray and the f64 map and profile that a kernel sees, in render space. Writes: hit or miss and t, the
//! roots with a relative error below 2^-300.

use super::enclosure::Enclosure;
use super::exact::Dyadic;
use super::exact_vector::Vector;
use super::number::Number;
use glam::{DVec3, Vec3};
use pinhole::shapes::{Frustum, UnitSpace};

/// A v, in unit space.
pub(super) fn to_unit<N: Number>(space: &UnitSpace, v: &Vector<N>) -> [N; 3] {
    [0, 1, 2].map(|row| Vector::of(space.unit_from_world.row(row).to_array()).dot(v))
}

/// The smallest t > 0 of an intersection, if there is one; nothing where these numbers cannot tell.
fn hit<N: Number>(origin: Vec3, direction: Vec3, frustum: &Frustum) -> Option<Option<N>> {
    let space = &frustum.space;
    let [x, y, z]: [N; 3] = to_unit(space, &Vector::of(origin).minus(&Vector::of(space.centre)));
    let [u, v, w]: [N; 3] = to_unit(space, &Vector::of(direction));
    let (middle, slope) = (N::of(frustum.profile[0]), N::of(frustum.profile[1]));
    // x² + z² − (a + by)² along the ray, which is below 0 where a cap ends at its rim.
    let (radius, change) = (middle.plus(&slope.by(&y)), slope.by(&v));
    let excess = x.by(&x).plus(&z.by(&z)).less(&radius.by(&radius));
    let half = x.by(&u).plus(&z.by(&w)).less(&radius.by(&change));
    let square = u.by(&u).plus(&w.by(&w)).less(&change.by(&change));
    let mut candidates = Vec::new();
    if frustum.capped && v.sign()? != 0 {
        for end in [-1.0, 1.0] {
            let t = N::of(end).less(&y).over(&v);
            let beyond = excess.plus(&t.by(&half.plus(&half).plus(&square.by(&t))));
            candidates.push((t, N::of(0.0).less(&beyond)));
        }
    }
    let discriminant = half.by(&half).less(&square.by(&excess));
    if discriminant.sign()? >= 0 {
        let root = discriminant.root();
        let sum = if half.sign()? < 0 { root.less(&half) } else { N::of(0.0).less(&root.plus(&half)) };
        for (over, under) in [(sum.clone(), square), (excess, sum)] {
            if under.sign()? != 0 {
                let t = over.over(&under);
                let height = y.plus(&t.by(&v));
                candidates.push((t, N::of(1.0).less(&height.by(&height))));
            }
        }
    }
    let mut closest: Option<N> = None;
    for (t, within) in candidates {
        if t.sign()? > 0 && within.sign()? >= 0 {
            let is_closer = closest.as_ref().is_none_or(|before| t.less(before).sign().is_some_and(|sign| sign < 0));
            closest = if is_closer { Some(t) } else { closest };
        }
    }
    Some(closest)
}

/// The smallest t > 0 at which the ray intersects it, rounded to f64; nothing when it does not.
#[must_use]
pub fn frustum_t(origin: Vec3, direction: Vec3, frustum: &Frustum) -> Option<f64> {
    let enclosed =
        hit::<Enclosure>(origin, direction, frustum).and_then(|t| t.map_or(Some(None), |t| t.rounded().map(Some)));
    enclosed.unwrap_or_else(|| hit::<Dyadic>(origin, direction, frustum).flatten().map(|t| t.to_f64()))
}

/// 1 where the point lies outside, −1 inside, 0 on it, exactly; if it is open, inside is what its side goes around,
/// however far beyond its ends.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn side_of_frustum(point: DVec3, frustum: &Frustum) -> i32 {
    fn side<N: Number>(point: DVec3, frustum: &Frustum) -> Option<i32> {
        let [x, y, z]: [N; 3] = to_unit(&frustum.space, &Vector::of(point).minus(&Vector::of(frustum.space.centre)));
        let radius = N::of(frustum.profile[0]).plus(&N::of(frustum.profile[1]).by(&y));
        let around = if radius.sign()? < 0 { 1 } else { x.by(&x).plus(&z.by(&z)).less(&radius.by(&radius)).sign()? };
        let beyond = if frustum.capped { y.by(&y).less(&N::of(1.0)).sign()? } else { -1 };
        Some(around.max(beyond))
    }
    side::<Enclosure>(point, frustum).or_else(|| side::<Dyadic>(point, frustum)).unwrap_or(0)
}
