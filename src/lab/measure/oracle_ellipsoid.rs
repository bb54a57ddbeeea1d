//! The exact oracle of a ray against an ellipsoid.
//!
//! Reads: the f32 ray and the f64 ellipsoid that a kernel sees, in render space. Writes: hit or miss without any
//! rounding, the roots t and the normal there with a relative error below 2^-300.
//! What is exact is the shape that the table describes, |A (x − C)| = 1; that A itself is the author's placement turned
//! round and rounded is another matter, checked by `extremes transform` in pixels.

use super::enclosure::Enclosure;
use super::exact::Dyadic;
use super::exact_vector::{EnclosedVector, ExactVector, Vector};
use super::number::Number;
use super::oracle_sphere::Roots;
use glam::{DVec3, Vec3};
use pinhole::shapes::Ellipsoid;

/// A v.
fn to_unit<N: Number>(ellipsoid: &Ellipsoid, v: &Vector<N>) -> Vector<N> {
    let [x, y, z] = [0, 1, 2].map(|row| Vector::of(ellipsoid.unit_from_world.row(row).to_array()).dot(v));
    Vector { x, y, z }
}

fn from_centre<N: Number>(point: &Vector<N>, ellipsoid: &Ellipsoid) -> Vector<N> {
    point.minus(&Vector::of(ellipsoid.centre))
}

/// Where the line of the ray intersects the ellipsoid, if it does; nothing where these numbers cannot tell.
///
/// With p = A (O − C) and q = A R the roots solve (q·q) t² + 2 (p·q) t + (p·p − 1) = 0.
fn roots<N: Number>(origin: Vec3, direction: Vec3, ellipsoid: &Ellipsoid) -> Option<Option<Roots<N>>> {
    let p: Vector<N> = to_unit(ellipsoid, &from_centre(&Vector::of(origin), ellipsoid));
    let q: Vector<N> = to_unit(ellipsoid, &Vector::of(direction));
    let (a, half_b, c) = (q.dot(&q), N::of(0.0).less(&p.dot(&q)), p.dot(&p).less(&N::of(1.0)));
    let discriminant = half_b.by(&half_b).less(&a.by(&c));
    if discriminant.sign()? < 0 || a.sign()? == 0 {
        return Some(None);
    }
    // The larger root has no cancellation, and the product of both is c / a.
    let root = discriminant.root();
    let negative = half_b.sign()? < 0;
    let larger = if negative { half_b.less(&root) } else { half_b.plus(&root) };
    let outer = larger.over(&a);
    let inner = if larger.sign()? == 0 { N::of(0.0) } else { c.over(&larger) };
    Some(Some(if negative { Roots { near: outer, far: inner } } else { Roots { near: inner, far: outer } }))
}

/// Where the line of the ray intersects the ellipsoid, or nothing when it passes by or the direction is zero.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn line_roots(origin: Vec3, direction: Vec3, ellipsoid: &Ellipsoid) -> Option<Roots> {
    roots(origin, direction, ellipsoid).flatten()
}

/// The nearest t > 0 at which the ray hits the ellipsoid's surface, or nothing when it does not.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn ellipsoid_hit(origin: Vec3, direction: Vec3, ellipsoid: &Ellipsoid) -> Option<Dyadic> {
    let Roots { near, far } = line_roots(origin, direction, ellipsoid)?;
    [near, far].into_iter().find(|root| root.sign() > 0)
}

/// The same t, rounded to f64 once.
#[must_use]
pub fn ellipsoid_t(origin: Vec3, direction: Vec3, ellipsoid: &Ellipsoid) -> Option<f64> {
    enclosed_ellipsoid_t(origin, direction, ellipsoid)
        .unwrap_or_else(|| ellipsoid_hit(origin, direction, ellipsoid).map(|t| t.to_f64()))
}

/// The same by enclosures; nothing where these cannot tell.
pub fn enclosed_ellipsoid_t(origin: Vec3, direction: Vec3, ellipsoid: &Ellipsoid) -> Option<Option<f64>> {
    let Some(Roots { near, far }) = roots::<Enclosure>(origin, direction, ellipsoid)? else { return Some(None) };
    for root in [near, far] {
        if root.sign()? > 0 {
            return root.rounded().map(Some);
        }
    }
    Some(None)
}

/// |A (x − C)|² − 1: positive outside, negative inside.
fn excess_of<N: Number>(point: DVec3, ellipsoid: &Ellipsoid) -> N {
    let unit: Vector<N> = to_unit(ellipsoid, &from_centre(&Vector::of(point), ellipsoid));
    unit.dot(&unit).less(&N::of(1.0))
}

/// |A (x − C)|² − 1, exactly: positive outside, negative inside.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn excess(point: DVec3, ellipsoid: &Ellipsoid) -> Dyadic {
    excess_of(point, ellipsoid)
}

/// 1 where the point lies outside, −1 inside, 0 on the ellipsoid, exactly.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn side_of_ellipsoid(point: DVec3, ellipsoid: &Ellipsoid) -> i32 {
    excess_of::<Enclosure>(point, ellipsoid).sign().unwrap_or_else(|| excess(point, ellipsoid).sign())
}

/// Aᵀ A (O + tR − C): along the outward normal where the ray has come at t, of no particular length.
fn outward_at<N: Number>(origin: Vec3, direction: Vec3, t: &N, ellipsoid: &Ellipsoid) -> Vector<N> {
    let along_ray = Vector::of(direction).times(&N::of(0.0).less(t));
    let unit = to_unit(ellipsoid, &from_centre(&Vector::of(origin), ellipsoid).minus(&along_ray));
    let [x, y, z] = [0, 1, 2].map(|column| Vector::of(ellipsoid.unit_from_world.col(column)).dot(&unit));
    Vector { x, y, z }
}

/// Along the outward normal where the ray first hits the ellipsoid, of no particular length; nothing where it does not.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn outward(origin: Vec3, direction: Vec3, ellipsoid: &Ellipsoid) -> Option<ExactVector> {
    let t = ellipsoid_hit(origin, direction, ellipsoid)?;
    Some(outward_at(origin, direction, &t.shortened(), ellipsoid))
}

/// The same by enclosures; nothing where these cannot tell, or the ray does not hit it.
pub fn enclosed_outward(origin: Vec3, direction: Vec3, ellipsoid: &Ellipsoid) -> Option<EnclosedVector> {
    let Roots { near, far } = roots::<Enclosure>(origin, direction, ellipsoid)??;
    let t = if near.sign()? > 0 { near } else { far };
    (t.sign()? > 0).then(|| outward_at(origin, direction, &t, ellipsoid))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;
    use crate::measure::exact::relative_error;
    use crate::measure::oracle_sphere::{Sphere, sphere_hit};
    use crate::measure::ray_aim::rounded_ray;
    use glam::DMat3;

    /// Half axes 1, 2, 4 along x, y, z.
    fn egg() -> Ellipsoid {
        let unit_from_world = DMat3::from_diagonal(DVec3::new(1.0, 0.5, 0.25));
        Ellipsoid::new(DVec3::new(0.0, 0.0, -10.0), unit_from_world, 4.0)
    }

    #[test]
    fn poles_are_hit_where_the_half_axes_end() {
        let hit = |origin, direction| ellipsoid_hit(origin, direction, &egg()).map(|t| t.to_f64());
        assert_eq!(hit(Vec3::ZERO, Vec3::NEG_Z), Some(6.0));
        assert_eq!(hit(Vec3::new(0.0, 5.0, -10.0), Vec3::NEG_Y), Some(3.0));
        assert_eq!(hit(Vec3::new(0.0, 0.0, -10.0), Vec3::X), Some(1.0));
        assert_eq!(hit(Vec3::ZERO, Vec3::Z), None);
        // A tangent is a hit, the next number a miss.
        assert_eq!(hit(Vec3::X, Vec3::NEG_Z), Some(10.0));
        assert_eq!(hit(Vec3::X * (1.0 + f32::EPSILON), Vec3::NEG_Z), None);
    }

    #[test]
    fn an_even_one_is_decided_as_the_sphere_oracle_does() {
        let mut hits = 0;
        for index in 0..500 {
            let mut draws = Draws::new(81, index);
            // A radius whose inverse is exact.
            let sphere = Sphere { centre: draws.unit_vector() * draws.power_of_ten(0.0, 6.0), radius: 0.5 };
            let even = Ellipsoid::new(sphere.centre, DMat3::from_diagonal(DVec3::splat(2.0)), 0.5);
            let limb = draws.unit_vector_across(sphere.centre.normalize()) * draws.between(0.4, 0.6);
            let ray = rounded_ray(Vec3::ZERO, sphere.centre + limb);
            let t = ellipsoid_hit(ray.origin, ray.direction, &even).map(|t| t.to_f64());
            assert_eq!(t, sphere_hit(ray.origin, ray.direction, sphere).map(|t| t.to_f64()));
            hits += u32::from(t.is_some());
        }
        assert!((100..400).contains(&hits), "{hits} of 500 rays hit");
    }

    #[test]
    fn normals_stand_across_the_surface() {
        let (origin, direction) = (Vec3::new(0.25, 0.5, 0.0), Vec3::new(0.0, 0.125, -1.0));
        let t = ellipsoid_hit(origin, direction, &egg()).expect("a hit");
        let normal = outward(origin, direction, &egg()).expect("a hit");
        // The gradient by hand: x / 1, y / 4, z / 16 from the centre.
        let t = t.to_f64();
        let expected = [0.25, (0.5 + 0.125 * t) / 4.0, (10.0 - t) / 16.0];
        for (part, expected) in [normal.x, normal.y, normal.z].iter().zip(expected) {
            assert!(relative_error(expected, part) < 1e-14);
        }
        assert!(excess(DVec3::new(0.0, 0.0, -6.0), &egg()).sign() == 0);
        assert!(excess(DVec3::new(1.0 + f64::EPSILON, 0.0, -10.0), &egg()).sign() > 0);
    }
}
