//! Test rays that make the decision hard: aimed at silhouettes, along planes, from everywhere at
//! any size.
//!
//! Every ray is a pure function of (seed, index), so a failure is named by two numbers. Directions
//! are made and normalised in f64, then rounded to f32, as a camera's are.

use super::draws::Draws;
use super::oracle_plane::Plane;
use super::oracle_sphere::Sphere;
use glam::{DVec3, Vec3};

/// One direction quantum: the spacing of f32 numbers just below 1.
const QUANTUM: f64 = 1.0 / (1u64 << 24) as f64;

/// How far about a silhouette rays are spread, in direction quanta to each side.
pub const BAND_IN_QUANTA: f64 = 4.0;

/// A ray in render space, as a kernel sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AimedRay {
    /// The origin, in scene units.
    pub origin: Vec3,
    /// The direction, of unit length up to its rounding.
    pub direction: Vec3,
}

/// The ray from `origin` along `direction`: normalised in f64, then rounded to f32.
#[must_use]
pub fn rounded_ray(origin: Vec3, direction: DVec3) -> AimedRay {
    let unit = direction / libm::sqrt(direction.length_squared());
    AimedRay { origin, direction: unit.as_vec3() }
}

/// A ray from the eye to a sphere `distance` radii away, off its centre by `tangents` of the
/// tangent angle and `quanta` direction quanta more: 0 is the centre, 1 the silhouette.
fn ray_off_centre(draws: &mut Draws, radius: f64, distance: f64, tangents: f64, quanta: f64) -> (AimedRay, Sphere) {
    let towards = draws.unit_vector();
    let across = draws.unit_vector_across(towards);
    let sphere = Sphere { centre: towards * (distance * radius), radius };
    let angle = libm::asin(1.0 / distance) * tangents + quanta * QUANTUM;
    let direction = towards * libm::cos(angle) + across * libm::sin(angle);
    (rounded_ray(Vec3::ZERO, direction), sphere)
}

/// A ray at the silhouette of a sphere of radius 0.5 to 2 whose centre is `distance` radii away,
/// spread over `BAND_IN_QUANTA` to each side: hits and misses are both common, and most are close.
#[must_use]
pub fn silhouette(seed: u64, index: u64, distance: f64) -> (AimedRay, Sphere) {
    let mut draws = Draws::new(seed, index);
    let (radius, quanta) = (draws.between(0.5, 2.0), draws.between(-BAND_IN_QUANTA, BAND_IN_QUANTA));
    ray_off_centre(&mut draws, radius, distance, 1.0, quanta)
}

/// A ray at the horizon of a sphere of this radius, seen from `height` above it: the same band.
#[must_use]
pub fn horizon(seed: u64, index: u64, radius: f64, height: f64) -> (AimedRay, Sphere) {
    let mut draws = Draws::new(seed, index);
    let quanta = draws.between(-BAND_IN_QUANTA, BAND_IN_QUANTA);
    ray_off_centre(&mut draws, radius, 1.0 + height / radius, 1.0, quanta)
}

/// A ray that is a tangent up to the rounding of its direction.
#[must_use]
pub fn tangent(seed: u64, index: u64, radius: f64, distance: f64) -> (AimedRay, Sphere) {
    ray_off_centre(&mut Draws::new(seed, index), radius, distance, 1.0, 0.0)
}

/// A ray anywhere over the disc of the sphere, from its centre to its silhouette.
#[must_use]
pub fn disc(seed: u64, index: u64, radius: f64, distance: f64) -> (AimedRay, Sphere) {
    let mut draws = Draws::new(seed, index);
    let tangents = draws.unit();
    ray_off_centre(&mut draws, radius, distance, tangents, 0.0)
}

/// A ray at the sphere's centre.
#[must_use]
pub fn centre(seed: u64, index: u64, radius: f64, distance: f64) -> (AimedRay, Sphere) {
    ray_off_centre(&mut Draws::new(seed, index), radius, distance, 0.0, 0.0)
}

/// A sphere of radius, distance from the eye and distance from the ray's origin each 10^U(−8, 8),
/// and a ray aimed at a point of its surface; where f32 is too coarse for the place the ray may
/// miss.
#[must_use]
pub fn sphere_of_any_size(seed: u64, index: u64) -> (AimedRay, Sphere) {
    let mut draws = Draws::new(seed, index);
    let radius = draws.power_of_ten(-8.0, 8.0);
    let sphere = Sphere { centre: draws.unit_vector() * draws.power_of_ten(-8.0, 8.0), radius };
    let surface = sphere.centre + draws.unit_vector() * radius;
    let leaving = draws.unit_vector() * draws.power_of_ten(-8.0, 8.0);
    let origin = (surface + leaving).as_vec3();
    (rounded_ray(origin, surface - origin.as_dvec3()), sphere)
}

/// The same from the eye: a primary ray, whose sphere lies up to 10^8 away and is as large as it
/// likes.
#[must_use]
pub fn seen_sphere_of_any_size(seed: u64, index: u64) -> (AimedRay, Sphere) {
    let mut draws = Draws::new(seed, index);
    let (radius, height) = (draws.power_of_ten(-8.0, 8.0), draws.power_of_ten(-8.0, 8.0));
    let tangents = draws.unit();
    ray_off_centre(&mut draws, radius, 1.0 + height / radius, tangents, 0.0)
}

/// A plane of offset and viewing distance 10^U(−8, 8), and a ray at it whose slope is
/// 10^U(−`flattest`, 0): the larger `flattest`, the more grazing the view.
#[must_use]
pub fn plane_of_any_offset(seed: u64, index: u64, flattest: f64) -> (AimedRay, Plane) {
    let mut draws = Draws::new(seed, index);
    let plane = Plane { normal: draws.unit_vector(), offset: draws.power_of_ten(-8.0, 8.0) };
    let along = draws.unit_vector_across(plane.normal);
    let foot = plane.normal * plane.offset + along * draws.power_of_ten(-8.0, 8.0);
    let slope = draws.power_of_ten(-flattest, 0.0);
    let direction = draws.unit_vector_across(plane.normal) - plane.normal * slope;
    let origin = (foot - direction * draws.power_of_ten(-8.0, 8.0)).as_vec3();
    (rounded_ray(origin, direction), plane)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::oracle_plane::plane_hit;
    use crate::measure::oracle_sphere::sphere_hit;

    const RAYS: u64 = 2000;

    fn hits(case: impl Fn(u64) -> (AimedRay, Sphere)) -> u64 {
        let hit = |(ray, sphere): (AimedRay, Sphere)| sphere_hit(ray.origin, ray.direction, sphere).is_some();
        (0..RAYS).filter(|index| hit(case(*index))).count() as u64
    }

    #[test]
    fn draws_depend_on_seed_and_index_alone() {
        let first = |seed, index| Draws::new(seed, index).unit();
        assert_eq!(first(1, 2), first(1, 2));
        assert_ne!(first(1, 2), first(2, 1));
        let mean = (0..RAYS).map(|index| first(7, index)).sum::<f64>() / RAYS as f64;
        assert!((mean - 0.5).abs() < 0.03, "{RAYS} draws have the mean {mean}");
    }

    #[test]
    fn silhouettes_both_hit_and_miss() {
        for distance in [1e3, 1e5, 1e7] {
            let hits = hits(|index| silhouette(1, index, distance));
            eprintln!("silhouette at {distance:e} radii: {hits} of {RAYS} rays hit");
            assert!((RAYS / 20..RAYS - RAYS / 20).contains(&hits));
        }
        let hits = hits(|index| horizon(2, index, 1e6, 1.0));
        eprintln!("horizon of a sphere of radius 1e6 from height 1: {hits} of {RAYS} rays hit");
        assert!((RAYS / 20..RAYS - RAYS / 20).contains(&hits));
    }

    #[test]
    fn the_centre_is_hit_and_planes_mostly() {
        assert_eq!(hits(|index| centre(3, index, 1.0, 1e5)), RAYS);
        let plane = |index| plane_of_any_offset(4, index, 8.0);
        let hit = |(ray, plane): (AimedRay, Plane)| plane_hit(ray.origin, ray.direction, plane).is_some();
        let hits = (0..RAYS).filter(|index| hit(plane(*index))).count() as u64;
        eprintln!("planes of any offset: {hits} of {RAYS} rays hit");
        assert!(hits > RAYS / 4);
    }
}
