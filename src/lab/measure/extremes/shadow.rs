//! Shadow rays: does the start lie strictly on its side of the surface that it leaves?
//!
//! A hit stores its position p and its unit normal n as f32, and a bound B; the shadow ray starts at
//! p' = fl(p + fl(n B)). Let o be the ray's origin, s the size of the shape's numbers (|c|₁ + r, or |k|), u = 2⁻²⁴,
//! ε = 2⁻⁵³. Claim: B = 4u|p|₁ + 2⁻⁴⁸ (|o|₁ + s) + 2⁻¹⁴⁶ puts p' strictly on the viewer's side.
//!
//! *Computing.* The f64 position P = o + tR lies off the surface by at most E = 1.2 · 2⁻⁴⁹ (|o|₁ + s + |p|₁). An error
//! of t moves P along the ray, and what of that leaves the surface is 2⁻⁵⁰|f| for the discriminant (its bound over
//! 2r), 2⁻⁵⁰|f| for f·f − r², or 7ε of the largest number for a plane's two sums; the sum o + tR adds 3ε.
//!
//! *Rounding.* P to p costs u(|pᵢ| + 2⁻¹²⁶) a component, nB costs uB + 2⁻¹⁵⁰, p' costs u(|pᵢ| + B) + 2⁻¹⁵⁰; along any
//! unit vector that is at most 2u|p|₁ + 4uB + 2⁻¹⁴⁷. What is left of B along n is at least
//! (1 − 8u)B − 2u|p|₁ − E − 2⁻¹⁴⁷ > u|p|₁ + 2⁻⁵⁰(|o|₁ + s) > 0, so that the next kernel sees it too.
//!
//! *Outside.* The tangent plane at the true point has the whole sphere behind it, so to be before it is to be outside.
//! The computed n may lean by 2ε(|c| + r)/r, which is of consequence only when r < u|p|₁, and then B > 2r + 2u|p|₁ clears the
//! sphere in every direction. *Inside* the same holds while r ≥ 2B: below that no room is left to start in.

use super::plane::{aim as aim_at_plane, by_function as plane_by_function};
use super::shadow_stages::{Shadow, ShadowStages, leaving};
use super::sphere::by_function as sphere_by_function;
use super::{Group, Method, Score, Tally, Trial};
use crate::measure::oracle_plane::{Plane, plane_t, side_of_plane};
use crate::measure::oracle_sphere::{Sphere, line_ts, side_of_sphere, sphere_t};
use crate::measure::ray_aim::{self, AimedRay, Draws};
use crate::naive::shadow::{ShadowStart, start_after_constant, start_at_hit, start_off_surface};
use glam::Vec3;
use pinhole::intersect::Surface;
use std::cmp::Ordering;
use std::ops::Range;

const METHODS: [Method; 4] = [
    Method::pinhole("pinhole, bound of the hit", "", 0.0),
    Method::naive("naive, at the hit", "", 0.0),
    Method::naive("naive, t > 1e-3", "", 0.0),
    Method::naive("naive, hit + 1e-4 n", "", 0.0),
];
/// Points farther away than this are beyond what f32 can carry on from.
const FARTHEST: f32 = 1e30;

type AimAtSphere = fn(u64) -> (AimedRay, Sphere);

/// The cases of starts.
pub fn trials() -> Vec<Trial> {
    let [small, smallest] = [-100, -130].map(|power| libm::exp2(f64::from(power)));
    let any: AimAtSphere = |index| ray_aim::sphere_of_any_size(41, index);
    let spheres: [(&str, f64, AimAtSphere); 6] = [
        ("spheres of any size and place 1e-8 to 1e8", 1.0, any),
        ("the same, 2^-100 as large", small, any),
        ("the same, 2^-130 as large: subnormal", smallest, any),
        ("spheres of any size 1e-8 to 1e8, seen", 1.0, |index| ray_aim::seen_sphere_of_any_size(42, index)),
        ("silhouettes at 1e5 radii", 1.0, |index| ray_aim::silhouette(43, index, 1e5)),
        ("horizons of radius 1e6 from height 1", 1.0, |index| ray_aim::horizon(44, index, 1e6, 1.0)),
    ];
    let planes = [
        ("planes of any offset and place 1e-8 to 1e8", 1.0, 0.0),
        ("the same, seen at slopes from 1e-4", 1.0, 4.0),
        ("the same, seen at slopes from 1e-12", 1.0, 12.0),
        ("the same, slopes from 1e-8, 2^-100 as large", small, 8.0),
        ("the same, slopes from 1e-8, 2^-130 as large: subnormal", smallest, 8.0),
    ];
    let sphere =
        |(name, scale, aim)| Trial::new(Group::Shadow, name, &METHODS, move |range| check_spheres(scale, aim, range));
    let plane = |(name, scale, flattest)| {
        Trial::new(Group::Shadow, name, &METHODS, move |range| check_planes(scale, flattest, range))
    };
    spheres.map(sphere).into_iter().chain(planes.map(plane)).collect()
}

/// The ray from `scale` times its origin.
fn scaled(ray: AimedRay, scale: f64) -> AimedRay {
    AimedRay { origin: (ray.origin.as_dvec3() * scale).as_vec3(), ..ray }
}

/// The shadow ray to a light in a direction above the surface, often a grazing one.
fn leave(stages: &mut ShadowStages, surface: Surface, size: f64, draws: &mut Draws) -> Option<Shadow> {
    let away = leaving(draws, surface.normal, 6.0) * (size * draws.power_of_ten(-2.0, 3.0));
    stages.shadow(surface, surface.position.as_dvec3() + away)
}

fn check_spheres(scale: f64, aim: AimAtSphere, range: Range<u64>) -> Tally {
    let (mut tally, mut stages) = (Tally::new(METHODS.len()), ShadowStages::of_spheres());
    for index in range {
        let (ray, sphere) = aim(index);
        let ray = scaled(ray, scale);
        let sphere = Sphere { centre: sphere.centre * scale, radius: sphere.radius * scale };
        stages.spheres(&[sphere]);
        let started = start_on_sphere(&mut stages, ray, sphere, &mut Draws::new(45, index));
        tally.count(started.is_some());
        if let Some((side, surface, shadow)) = started {
            tally.scores[0].check(sphere_is_left(side, shadow, sphere));
            if side == Ordering::Greater {
                check_naive(surface, shadow.direction, &mut tally.scores[1..], |start, direction| {
                    let ts = line_ts(start.origin, direction, sphere);
                    ts.is_some_and(|ts| ts.iter().any(|&t| t > f64::from(start.t_min)))
                });
            }
        }
    }
    tally
}

/// On which side the viewer is, what it hits, and the shadow ray from there; none where there is nothing to start from,
/// or inside a sphere so small that nothing representable lies between its walls.
fn start_on_sphere(
    stages: &mut ShadowStages,
    ray: AimedRay,
    sphere: Sphere,
    draws: &mut Draws,
) -> Option<(Ordering, Surface, Shadow)> {
    let (_, surface) = stages.surface(ray)?;
    let side = side_of_sphere(ray.origin.as_dvec3(), sphere);
    let room = side == Ordering::Greater || sphere.radius >= 2.0 * f64::from(surface.bound);
    if side == Ordering::Equal || !room {
        return None;
    }
    let size = sphere.radius + surface.position.as_dvec3().length();
    Some((side, surface, leave(stages, surface, size, draws)?))
}

/// Whether the start lies strictly on the viewer's side, and pinhole's kernels say of the ray what is exactly so:
/// from outside a ray that leaves never comes back, from inside it hits the far side.
fn sphere_is_left(side: Ordering, shadow: Shadow, sphere: Sphere) -> bool {
    let Shadow { origin, direction, blocked, .. } = shadow;
    let hits = sphere_by_function(AimedRay { origin, direction }, sphere).is_finite();
    let exactly = sphere_t(origin, direction, sphere).is_some();
    let outside = side == Ordering::Greater;
    side_of_sphere(origin.as_dvec3(), sphere) == side && hits == exactly && !(outside && (hits || blocked.is_some()))
}

fn check_planes(scale: f64, flattest: f64, range: Range<u64>) -> Tally {
    let (mut tally, mut stages) = (Tally::new(METHODS.len()), ShadowStages::of_planes());
    for index in range {
        let (ray, plane) = aim_at_plane(46, index, flattest);
        let (ray, plane) = (scaled(ray, scale), Plane { offset: plane.offset * scale, ..plane });
        stages.planes(&[plane]);
        let side = side_of_plane(ray.origin.as_dvec3(), plane);
        let surface = stages.surface(ray).map(|(_, surface)| surface);
        let surface = surface.filter(|surface| surface.position.abs().max_element() < FARTHEST);
        let shadow = surface.and_then(|surface| {
            let size = surface.position.as_dvec3().length() + plane.offset.abs();
            Some((surface, leave(&mut stages, surface, size, &mut Draws::new(47, index))?))
        });
        tally.count(shadow.is_some());
        if let Some((surface, shadow)) = shadow {
            tally.scores[0].check(plane_is_left(side, shadow, plane));
            check_naive(surface, shadow.direction, &mut tally.scores[1..], |start, direction| {
                plane_t(start.origin, direction, plane).is_some_and(|t| t > f64::from(start.t_min))
            });
        }
    }
    tally
}

/// Whether the start lies strictly on the viewer's side, and the plane is not hit again.
fn plane_is_left(side: Ordering, shadow: Shadow, plane: Plane) -> bool {
    let Shadow { origin, direction, blocked, .. } = shadow;
    let hits = plane_by_function(AimedRay { origin, direction }, plane).is_finite();
    side_of_plane(origin.as_dvec3(), plane) == side && !hits && blocked.is_none()
}

/// Whether the naive starts shadow their own surface; their kernel is exact, so that only the start is checked.
fn check_naive(
    surface: Surface,
    direction: Vec3,
    scores: &mut [Score],
    hits_itself: impl Fn(ShadowStart, Vec3) -> bool,
) {
    let Surface { position, normal, .. } = surface;
    let starts = [start_at_hit(position), start_after_constant(position), start_off_surface(position, normal)];
    for (score, start) in scores.iter_mut().zip(starts) {
        score.check(!hits_itself(start, direction));
    }
}
