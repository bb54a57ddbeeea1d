//! The exact judge of a ray against an ellipsoid.
//!
//! Reads: the f32 ray and the f64 ellipsoid that a kernel sees, in render space. Writes: hit or miss without any
//! rounding, the roots t and the normal there with a relative error below 2^-300.
//! What is exact is the shape that the table describes, |A (x − C)| = 1; that A itself is the author's placement turned
//! round and rounded is another matter, judged by `extremes transform` in pixels.

use super::exact::Dyadic;
use super::exact_vector::ExactVector;
use super::oracle_sphere::Roots;
use crate::extract::Ellipsoid;
use glam::{DVec3, Vec3};

/// A v, exactly.
fn to_unit(ellipsoid: &Ellipsoid, v: &ExactVector) -> ExactVector {
    let [x, y, z] = [0, 1, 2].map(|row| ExactVector::of(ellipsoid.unit_from_world.row(row).to_array()).dot(v));
    ExactVector { x, y, z }
}

fn from_centre(point: &ExactVector, ellipsoid: &Ellipsoid) -> ExactVector {
    point.minus(&ExactVector::of(ellipsoid.centre))
}

/// Where the line of the ray meets the ellipsoid, or nothing when it passes by or the direction is zero.
///
/// With p = A (O − C) and q = A R the roots solve (q·q) t² + 2 (p·q) t + (p·p − 1) = 0.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn line_roots(origin: Vec3, direction: Vec3, ellipsoid: &Ellipsoid) -> Option<Roots> {
    let p = to_unit(ellipsoid, &from_centre(&ExactVector::of(origin), ellipsoid));
    let q = to_unit(ellipsoid, &ExactVector::of(direction));
    let (a, half_b, c) = (q.dot(&q), -&p.dot(&q), &p.dot(&p) - &Dyadic::of(1));
    let discriminant = &half_b.squared() - &(&a * &c);
    if discriminant.sign() < 0 || a.sign() == 0 {
        return None;
    }
    // The larger root has no cancellation, and the product of both is c / a.
    let root = discriminant.square_root();
    let negative = half_b.sign() < 0;
    let larger = if negative { &half_b - &root } else { &half_b + &root };
    let outer = larger.divided_by(&a);
    let inner = if larger.sign() == 0 { Dyadic::of(0) } else { c.divided_by(&larger) };
    Some(if negative { Roots { near: outer, far: inner } } else { Roots { near: inner, far: outer } })
}

/// The nearest t > 0 at which the ray meets the ellipsoid's surface, or nothing when it does not.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn ellipsoid_hit(origin: Vec3, direction: Vec3, ellipsoid: &Ellipsoid) -> Option<Dyadic> {
    let Roots { near, far } = line_roots(origin, direction, ellipsoid)?;
    [near, far].into_iter().find(|root| root.sign() > 0)
}

/// |A (x − C)|² − 1, exactly: positive outside, negative inside.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn excess(point: DVec3, ellipsoid: &Ellipsoid) -> Dyadic {
    let unit = to_unit(ellipsoid, &from_centre(&ExactVector::of(point), ellipsoid));
    &unit.dot(&unit) - &Dyadic::of(1)
}

/// Aᵀ A (O + tR − C): along the outward normal where the ray has come at t, of no particular length.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn outward(origin: Vec3, direction: Vec3, t: &Dyadic, ellipsoid: &Ellipsoid) -> ExactVector {
    let way = ExactVector::of(direction).times(&t.shortened());
    let from_centre = from_centre(&ExactVector::of(origin), ellipsoid).minus(&way.times(&Dyadic::of(-1)));
    let unit = to_unit(ellipsoid, &from_centre);
    let [x, y, z] = [0, 1, 2].map(|column| ExactVector::of(ellipsoid.unit_from_world.col(column)).dot(&unit));
    ExactVector { x, y, z }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::exact::relative_error;
    use crate::measure::oracle_sphere::{Sphere, sphere_hit};
    use crate::measure::ray_aim::{Draws, rounded_ray};
    use glam::DMat3;

    /// Half axes 1, 2, 4 along x, y, z.
    fn egg() -> Ellipsoid {
        let unit_from_world = DMat3::from_diagonal(DVec3::new(1.0, 0.5, 0.25));
        Ellipsoid::new(DVec3::new(0.0, 0.0, -10.0), unit_from_world, 4.0)
    }

    #[test]
    fn poles_are_met_where_the_half_axes_end() {
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
    fn an_even_one_is_judged_as_the_sphere_oracle_does() {
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
        let normal = outward(origin, direction, &t, &egg());
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
