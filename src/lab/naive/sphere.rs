//! Ray against sphere as the textbooks have it.

use glam::{DVec3, Vec3};

// ANCHOR: naive_hit_sphere_f32
/// The nearest t > 0 where the ray hits the sphere: the quadratic formula, straight from school,
/// in f32.
///
/// Nearly every first ray tracer has it. Far away b² and 4ac are both huge and nearly equal, so
/// their difference is made of rounding errors: from a thousand radii on, a ray within a few
/// rounding steps of the silhouette is decided no better than by a coin.
#[must_use]
pub fn hit_f32(origin: Vec3, direction: Vec3, centre: Vec3, radius: f32) -> Option<f32> {
    let from_centre = origin - centre;
    let a = direction.dot(direction);
    let b = 2.0 * from_centre.dot(direction);
    let c = from_centre.dot(from_centre) - radius * radius;
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return None;
    }
    let near = (-b - discriminant.sqrt()) / (2.0 * a);
    let far = (-b + discriminant.sqrt()) / (2.0 * a);
    [near, far].into_iter().find(|t| *t > 0.0)
}
// ANCHOR_END: naive_hit_sphere_f32

/// The same formula, halved, in f64 on f32 rays: the usual first repair.
///
/// It moves the failure away rather than removing it: b² and ac still agree in all but their last
/// digits when the sphere is far, so at 10^7 radii some silhouette rays are misclassified, and close
/// above a large sphere the near root loses its digits.
#[must_use]
pub fn hit_f64_plain(origin: Vec3, direction: Vec3, centre: DVec3, radius: f64) -> Option<f64> {
    let (direction, to_centre) = (direction.as_dvec3(), centre - origin.as_dvec3());
    let a = direction.dot(direction);
    let half_b = to_centre.dot(direction);
    let c = to_centre.dot(to_centre) - radius * radius;
    let discriminant = half_b * half_b - a * c;
    if discriminant < 0.0 {
        return None;
    }
    let near = (half_b - discriminant.sqrt()) / a;
    let far = (half_b + discriminant.sqrt()) / a;
    [near, far].into_iter().find(|t| *t > 0.0)
}

/// The perpendicular form in f32: the discriminant from how far the ray passes the centre, the
/// roots without cancellation (Haines et al., "Precision Improvements for Ray/Sphere Intersection",
/// Ray Tracing Gems, 2019).
///
/// Far better than the formula from school, but the first subtraction, origin minus centre, is
/// already rounded: above a sphere of radius 10^6 a height of 1 is known to a tenth at best.
#[must_use]
pub fn hit_haines_f32(origin: Vec3, direction: Vec3, centre: Vec3, radius: f32) -> Option<f32> {
    let to_centre = centre - origin;
    let a = direction.dot(direction);
    let half_b = to_centre.dot(direction);
    let passing = to_centre - direction * (half_b / a);
    let discriminant = radius * radius - passing.dot(passing);
    if discriminant < 0.0 {
        return None;
    }
    let c = to_centre.dot(to_centre) - radius * radius;
    let larger = half_b + half_b.signum() * (a * discriminant).sqrt();
    let (first, second) = (c / larger, larger / a);
    [first.min(second), first.max(second)].into_iter().find(|t| *t > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::oracle_sphere::{Sphere, sphere_hit};
    use crate::measure::ray_aim::{AimedRay, silhouette};

    #[test]
    fn in_front_of_the_eye_all_three_agree() {
        let (centre, radius) = (Vec3::new(0.0, 0.0, -3.0), 1.0);
        for (direction, t) in [(Vec3::NEG_Z, Some(2.0)), (Vec3::Z, None), (Vec3::X, None)] {
            assert_eq!(hit_f32(Vec3::ZERO, direction, centre, radius), t);
            assert_eq!(hit_haines_f32(Vec3::ZERO, direction, centre, radius), t);
            let in_f64 = hit_f64_plain(Vec3::ZERO, direction, centre.as_dvec3(), f64::from(radius));
            assert_eq!(in_f64, t.map(f64::from));
        }
    }

    /// How many silhouette rays a method classifies otherwise than the oracle, both on an f32 sphere.
    fn misclassified(rays: u64, distance: f64, hits: impl Fn(AimedRay, Vec3, f32) -> bool) -> usize {
        let wrong = |(ray, sphere): (AimedRay, Sphere)| {
            let sphere = sphere.rounded_to_f32();
            let (centre, radius) = (sphere.centre.as_vec3(), sphere.radius as f32);
            let exact = sphere_hit(ray.origin, ray.direction, sphere).is_some();
            hits(ray, centre, radius) != exact
        };
        let cases = (0..rays).map(|index| silhouette(11, index, distance));
        cases.filter(|case| wrong(*case)).count()
    }

    #[test]
    fn all_three_break_at_the_silhouette() {
        const RAYS: u64 = 4000;
        for distance in [1e3, 1e5, 1e7] {
            let plain = misclassified(RAYS, distance, |ray, centre, radius| {
                hit_f32(ray.origin, ray.direction, centre, radius).is_some()
            });
            let haines = misclassified(RAYS, distance, |ray, centre, radius| {
                hit_haines_f32(ray.origin, ray.direction, centre, radius).is_some()
            });
            let in_f64 = misclassified(RAYS, distance, |ray, centre, radius| {
                let (centre, radius) = (centre.as_dvec3(), f64::from(radius));
                hit_f64_plain(ray.origin, ray.direction, centre, radius).is_some()
            });
            eprintln!(
                "{RAYS} silhouette rays at {distance:e} radii, misclassified: \
                 {plain} f32, {haines} f32 perpendicular, {in_f64} f64"
            );
            assert!(plain > 0, "the textbook is expected to break");
            assert!(distance < 1e7 || in_f64 > 0, "f64 is expected to break");
        }
    }
}
