//! The exact oracle of a ray against a sphere.
//!
//! Reads: the f32 ray and the f64 sphere a kernel sees, in render space; the direction is taken as
//! given, unit or not. Writes: hit or miss without any rounding, and the roots t with a relative
//! error below 2^-300.

use super::enclosure::Enclosure;
use super::exact::{Dyadic, UNIT_ROUNDOFF_F32};
use super::exact_vector::Vector;
use super::number::Number;
use glam::{DVec3, Vec3};
use std::cmp::Ordering;

/// The sphere |x − centre| = radius, in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// The centre, relative to the eye, in scene units.
    pub centre: DVec3,
    /// The radius, in scene units.
    pub radius: f64,
}

impl Sphere {
    /// The sphere an f32 method sees, so that the oracle can check it with its own inputs.
    #[must_use]
    pub fn rounded_to_f32(self) -> Self {
        Self { centre: self.centre.as_vec3().as_dvec3(), radius: f64::from(self.radius as f32) }
    }
}

/// Where the ray's line intersects a sphere, as parameters t of origin + t · direction.
#[derive(Clone, Debug)]
pub struct Roots<N = Dyadic> {
    /// The smaller root.
    pub near: N,
    /// The larger root.
    pub far: N,
}

/// Where the line of the ray intersects the sphere, if it does; nothing where these numbers cannot tell.
///
/// With f = centre − origin the roots solve (d·d) t² − 2 (f·d) t + (f·f − r²) = 0.
fn roots<N: Number>(origin: Vec3, direction: Vec3, sphere: Sphere) -> Option<Option<Roots<N>>> {
    let direction = Vector::<N>::of(direction);
    let to_centre = Vector::<N>::of(sphere.centre).minus(&Vector::of(origin));
    let radius = N::of(sphere.radius);
    let a = direction.dot(&direction);
    let half_b = to_centre.dot(&direction);
    let c = to_centre.dot(&to_centre).less(&radius.by(&radius));
    let discriminant = half_b.by(&half_b).less(&a.by(&c));
    if discriminant.sign()? < 0 || a.sign()? == 0 {
        return Some(None);
    }
    let root = discriminant.root();
    // The root of larger magnitude has no cancellation, and the other follows from the product of
    // both, c / a.
    let behind = half_b.sign()? < 0;
    let larger = if behind { half_b.less(&root) } else { half_b.plus(&root) };
    let outer = larger.over(&a);
    let inner = if larger.sign()? == 0 { N::of(0.0) } else { c.over(&larger) };
    Some(Some(if behind { Roots { near: outer, far: inner } } else { Roots { near: inner, far: outer } }))
}

/// Where the line of the ray intersects the sphere, or nothing when it passes by or the direction is
/// zero.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn line_roots(origin: Vec3, direction: Vec3, sphere: Sphere) -> Option<Roots> {
    roots(origin, direction, sphere).flatten()
}

/// The same roots, near and far, rounded to f64 once.
#[must_use]
pub fn line_ts(origin: Vec3, direction: Vec3, sphere: Sphere) -> Option<[f64; 2]> {
    enclosed_line_ts(origin, direction, sphere).unwrap_or_else(|| {
        line_roots(origin, direction, sphere).map(|Roots { near, far }| [near.to_f64(), far.to_f64()])
    })
}

/// The same by enclosures; nothing where these cannot tell.
pub fn enclosed_line_ts(origin: Vec3, direction: Vec3, sphere: Sphere) -> Option<Option<[f64; 2]>> {
    match roots::<Enclosure>(origin, direction, sphere)? {
        None => Some(None),
        Some(Roots { near, far }) => Some(Some([near.rounded()?, far.rounded()?])),
    }
}

/// The nearest t > 0 at which the ray hits the sphere's surface, or nothing when it does not.
///
/// The decision is exact, because a root's sign is that of f·d, of f·f − r², or of a sum of two
/// numbers of one sign.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn sphere_hit(origin: Vec3, direction: Vec3, sphere: Sphere) -> Option<Dyadic> {
    let Roots { near, far } = line_roots(origin, direction, sphere)?;
    [near, far].into_iter().find(|root| root.sign() > 0)
}

/// The same t, rounded to f64 once.
#[must_use]
pub fn sphere_t(origin: Vec3, direction: Vec3, sphere: Sphere) -> Option<f64> {
    enclosed_sphere_t(origin, direction, sphere)
        .unwrap_or_else(|| sphere_hit(origin, direction, sphere).map(|t| t.to_f64()))
}

/// The same by enclosures; nothing where these cannot tell.
pub fn enclosed_sphere_t(origin: Vec3, direction: Vec3, sphere: Sphere) -> Option<Option<f64>> {
    let Some(Roots { near, far }) = roots::<Enclosure>(origin, direction, sphere)? else { return Some(None) };
    for root in [near, far] {
        if root.sign()? > 0 {
            return root.rounded().map(Some);
        }
    }
    Some(None)
}

/// How the point lies to the sphere, exactly: `Greater` is strictly outside, `Less` strictly
/// inside.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn side_of_sphere(point: DVec3, sphere: Sphere) -> Ordering {
    height::<Enclosure>(point, sphere).sign().unwrap_or_else(|| height::<Dyadic>(point, sphere).sign()).cmp(&0)
}

/// The squared distance from the centre less that of the surface.
fn height<N: Number>(point: DVec3, sphere: Sphere) -> N {
    let from_centre = Vector::<N>::of(point).minus(&Vector::of(sphere.centre));
    let radius = N::of(sphere.radius);
    from_centre.dot(&from_centre).less(&radius.by(&radius))
}

/// How far the point lies off the surface, over u (|c| + r), u = 2⁻²⁴.
#[must_use]
pub fn height_in_u(point: DVec3, sphere: Sphere) -> f64 {
    let enclosed = surface_height::<Enclosure>(point, sphere).about();
    let height = enclosed.unwrap_or_else(|| surface_height::<Dyadic>(point, sphere).to_f64());
    height.abs() / (UNIT_ROUNDOFF_F32 * (sphere.centre.length() + sphere.radius))
}

/// The distance from the centre less the radius.
fn surface_height<N: Number>(point: DVec3, sphere: Sphere) -> N {
    let from_centre = Vector::<N>::of(point).minus(&Vector::of(sphere.centre));
    from_centre.dot(&from_centre).root().less(&N::of(sphere.radius))
}

/// Whether the point lies strictly outside the sphere, exactly.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn strictly_outside(point: DVec3, sphere: Sphere) -> bool {
    side_of_sphere(point, sphere) == Ordering::Greater
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::exact::relative_error;

    const UNIT: Sphere = Sphere { centre: DVec3::new(0.0, 0.0, -3.0), radius: 1.0 };

    fn hit(origin: Vec3, direction: Vec3) -> Option<f64> {
        sphere_hit(origin, direction, UNIT).map(|root| root.to_f64())
    }

    #[test]
    fn the_nearest_positive_root_is_found_from_every_side() {
        assert_eq!(hit(Vec3::ZERO, Vec3::NEG_Z), Some(2.0));
        assert_eq!(hit(Vec3::ZERO, Vec3::NEG_Z * 4.0), Some(0.5));
        assert_eq!(hit(Vec3::new(0.0, 0.0, -3.0), Vec3::X), Some(1.0));
        assert_eq!(hit(Vec3::ZERO, Vec3::Z), None);
        assert_eq!(hit(Vec3::ZERO, Vec3::ZERO), None);
        // On the surface: outwards there is no further hit, inwards the far side.
        assert_eq!(hit(Vec3::new(0.0, 0.0, -2.0), Vec3::Z), None);
        assert_eq!(hit(Vec3::new(0.0, 0.0, -2.0), Vec3::NEG_Z), Some(2.0));
    }

    #[test]
    fn a_tangent_is_a_hit_and_one_place_further_is_a_miss() {
        assert_eq!(hit(Vec3::X, Vec3::NEG_Z), Some(3.0));
        assert_eq!(hit(Vec3::new(1.0 + f32::EPSILON, 0.0, 0.0), Vec3::NEG_Z), None);
        assert_eq!(hit(Vec3::new(1.0, 0.0, -3.0), Vec3::NEG_Z), None);
    }

    #[test]
    fn roots_multiply_to_c_over_a_and_lie_in_order() {
        let (origin, direction) = (Vec3::new(0.1, 0.2, 0.3), Vec3::new(0.1, -0.05, -1.1));
        for (origin, direction) in [(origin, direction), (origin, -direction)] {
            let Some(Roots { near, far }) = line_roots(origin, direction, UNIT) else {
                panic!("the line intersects the sphere");
            };
            assert!(near < far);
            let f = UNIT.centre - origin.as_dvec3();
            let d = direction.as_dvec3();
            let product = (f.length_squared() - 1.0) / d.length_squared();
            assert!(relative_error(product, &(&near * &far)) < 1e-14);
        }
    }

    #[test]
    fn sides_are_exact() {
        assert!(!strictly_outside(DVec3::new(0.0, 0.0, -2.0), UNIT));
        assert!(strictly_outside(DVec3::new(0.0, 0.0, -2.0 + f64::EPSILON), UNIT));
        let inside = DVec3::new(0.0, 0.0, -2.0 - 2.0 * f64::EPSILON);
        assert_eq!(side_of_sphere(inside, UNIT), Ordering::Less);
    }
}
