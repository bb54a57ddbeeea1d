//! The exact oracle of a ray against a plane.
//!
//! Reads: the f32 ray and the f64 plane a kernel sees, in render space. Writes: hit or miss without
//! any rounding, and t with a relative error below 2^-319.

use super::enclosure::Enclosure;
use super::exact::Dyadic;
use super::exact_vector::Vector;
use super::number::Number;
use glam::{DVec3, Vec3};
use std::cmp::Ordering;

/// The plane normal · x = offset, in render space; the normal counts as given, unit or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// The normal, of unit length as far as f64 can hold it.
    pub normal: DVec3,
    /// The distance of the plane from the eye along the normal, in scene units.
    pub offset: f64,
}

impl Plane {
    /// The plane an f32 method sees, so that the oracle can check it with its own inputs.
    #[must_use]
    pub fn rounded_to_f32(self) -> Self {
        Self { normal: self.normal.as_vec3().as_dvec3(), offset: f64::from(self.offset as f32) }
    }
}

/// offset − normal · point: positive below the plane, zero on it.
fn depth_below<N: Number>(point: &Vector<N>, plane: Plane) -> N {
    N::of(plane.offset).less(&Vector::of(plane.normal).dot(point))
}

/// The t > 0 at which the ray intersects the plane, if it does; nothing where these numbers cannot tell.
fn hit<N: Number>(origin: Vec3, direction: Vec3, plane: Plane) -> Option<Option<N>> {
    let distance: N = depth_below(&Vector::of(origin), plane);
    let approach: N = Vector::of(plane.normal).dot(&Vector::of(direction));
    // Two numbers of one sign have a positive quotient, so the decision needs no division.
    Some((distance.sign()? * approach.sign()? > 0).then(|| distance.over(&approach)))
}

/// The t > 0 at which the ray intersects the plane, or nothing when it is parallel, points away or
/// starts on it.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn plane_hit(origin: Vec3, direction: Vec3, plane: Plane) -> Option<Dyadic> {
    hit(origin, direction, plane).flatten()
}

/// The same t, rounded to f64 once.
#[must_use]
pub fn plane_t(origin: Vec3, direction: Vec3, plane: Plane) -> Option<f64> {
    enclosed_plane_t(origin, direction, plane)
        .unwrap_or_else(|| plane_hit(origin, direction, plane).map(|t| t.to_f64()))
}

/// The same by enclosures; nothing where these cannot tell.
pub fn enclosed_plane_t(origin: Vec3, direction: Vec3, plane: Plane) -> Option<Option<f64>> {
    match hit::<Enclosure>(origin, direction, plane)? {
        None => Some(None),
        Some(t) => t.rounded().map(Some),
    }
}

/// How the point lies to the plane, exactly: `Greater` is strictly on the side its normal points
/// to.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn side_of_plane(point: DVec3, plane: Plane) -> Ordering {
    let enclosed = depth_below::<Enclosure>(&Vector::of(point), plane).sign();
    0.cmp(&enclosed.unwrap_or_else(|| depth_below::<Dyadic>(&Vector::of(point), plane).sign()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLOOR: Plane = Plane { normal: DVec3::Y, offset: -2.0 };

    fn hit(origin: Vec3, direction: Vec3) -> Option<f64> {
        plane_hit(origin, direction, FLOOR).map(|root| root.to_f64())
    }

    #[test]
    fn both_sides_are_hit_and_only_in_front() {
        assert_eq!(hit(Vec3::ZERO, Vec3::NEG_Y), Some(2.0));
        assert_eq!(hit(Vec3::new(0.0, -3.0, 0.0), Vec3::Y), Some(1.0));
        assert_eq!(hit(Vec3::ZERO, Vec3::Y), None);
        assert_eq!(hit(Vec3::ZERO, Vec3::X), None);
        assert_eq!(hit(Vec3::new(7.0, -2.0, 0.0), Vec3::NEG_Y), None);
    }

    #[test]
    fn the_flattest_ray_still_has_its_hit() {
        let flattest = Vec3::new(1.0, -f32::from_bits(1), 0.0);
        assert_eq!(hit(Vec3::ZERO, flattest), Some(2.0 / f64::from(f32::from_bits(1))));
    }

    #[test]
    fn sides_are_exact() {
        let at_height = |y: f64| side_of_plane(DVec3::new(1e8, y, -1e8), FLOOR);
        assert_eq!(at_height(-2.0), Ordering::Equal);
        assert_eq!(at_height(-2.0 + 4.0 * f64::EPSILON), Ordering::Greater);
        assert_eq!(at_height(-2.0 - 4.0 * f64::EPSILON), Ordering::Less);
    }
}
