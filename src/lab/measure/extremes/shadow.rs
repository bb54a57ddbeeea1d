//! Shadow rays: does the start lie strictly on its side of the surface that it leaves, does what lies before the light
//! count, and what lies behind it not?
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
//!
//! *How far it looks.* A direction in f32 is off by less than u = 2⁻²⁴ across and u in length, so the ray passes a light at distance d by
//! less than ud. A wall that faces the ray at up to 78° is therefore hit no sooner than d(1 − 6u), and the t_max
//! d(1 − 8u), rounded, stops before it, be the wall ever so close behind the light. A wall along the ray would need a
//! finer direction: there the light has to stand off the wall by 4ud or more.

use super::shadow_stages::{Shadow, ShadowStages, leaving};
use super::{Group, Method, Score, Tally, Trial, shapes};
use crate::measure::draws::Draws;
use crate::measure::oracle_plane::{Plane, plane_t, side_of_plane};
use crate::measure::oracle_sphere::{Sphere, line_ts};
use crate::measure::ray_aim::{rounded_ray, seen_sphere_of_any_size};
use crate::naive::shadow::{ShadowStart, start_after_constant, start_off_surface, t_max_to_light, t_max_without_end};
use glam::{DVec3, Vec3};
use pinhole::intersect::Surface;
use std::cmp::Ordering;
use std::ops::Range;

const WALL: [Method; 3] = [
    Method::pinhole("pinhole, t_max of the shadow ray", "", 0.0),
    Method::naive("naive, reach without end", "", 0.0),
    Method::naive("naive, reach to the light", "", 0.0),
];
const BALL: [Method; 3] = [
    Method::pinhole("pinhole, bound of the hit", "", 0.0),
    Method::naive("naive, t > 1e-3", "", 0.0),
    Method::naive("naive, hit + 1e-4 n", "", 0.0),
];
/// u, half the spacing of f32 numbers from 1 on.
const U: f64 = crate::measure::exact::UNIT_ROUNDOFF_F32;

/// The cases of rays that leave every shape, of lights before walls and of small things before lights.
pub fn trials() -> Vec<Trial> {
    let facing = Standing { seed: 61, flattest: 0.7, min: 0.0, closest: -12.0 };
    let along = Standing { seed: 62, flattest: 8.0, min: 4.0 * U, closest: -9.0 };
    let wall = |name, standing| Trial::new(Group::Shadow, name, &WALL, move |range| check_walls(standing, range));
    let mut trials = shapes::leaving_trials();
    trials.extend([
        wall("a light before a wall that faces it, as close as f64 has it", facing),
        wall("a light before a wall at any angle, 4u of its distance off", along),
        Trial::new(Group::Shadow, "a small ball between surface and light, any size", &BALL, check_balls),
    ]);
    trials
}

/// How a light may stand before its wall.
#[derive(Clone, Copy)]
struct Standing {
    seed: u64,
    /// The wall faces the light with a cosine from 10 to minus this.
    flattest: f64,
    /// Its distance from the wall is at least this times that from the surface.
    min: f64,
    /// And 10 to this more.
    closest: f64,
}

fn check_walls(standing: Standing, range: Range<u64>) -> Tally {
    let (mut tally, mut stages) = (Tally::new(WALL.len()), ShadowStages::of_planes());
    for index in range {
        let shadow = shadow_before_wall(standing, index, &mut stages);
        tally.count(shadow.is_some());
        let Some((shadow, wall, distance)) = shadow else { continue };
        tally.scores[0].check(shadow.blocked.is_none());
        let to_wall = plane_t(shadow.origin, shadow.direction, wall);
        for (score, t_max) in tally.scores[1..].iter_mut().zip([t_max_without_end(distance), t_max_to_light(distance)])
        {
            score.check(to_wall.is_none_or(|t| t >= f64::from(t_max)));
        }
    }
    tally
}

/// The shadow ray from a floor to a light that stands exactly before a wall, as the surface does; the wall, and how far
/// the light is.
fn shadow_before_wall(standing: Standing, index: u64, stages: &mut ShadowStages) -> Option<(Shadow, Plane, f64)> {
    let mut draws = Draws::new(standing.seed, index);
    let normal = draws.unit_vector().as_vec3();
    let up = normal.as_dvec3();
    let foot = (draws.unit_vector() * draws.power_of_ten(-8.0, 8.0)).as_vec3();
    let floor = Plane { normal: up, offset: up.dot(foot.as_dvec3()) };
    let size = f64::from(foot.length());
    let away = leaving(&mut draws, normal, 3.0).normalize() * (size * draws.power_of_ten(-2.0, 3.0));
    let light = foot.as_dvec3() + away;

    let cosine = draws.power_of_ten(-standing.flattest, 0.0);
    let ahead = away.normalize();
    let across = draws.unit_vector_across(ahead) * libm::sqrt(1.0 - cosine * cosine);
    let facing = (across - ahead * cosine).as_vec3().as_dvec3();
    let off = away.length() * (standing.min + draws.power_of_ten(standing.closest, 0.0));
    let wall = Plane { normal: facing, offset: facing.dot(light) - off };

    stages.planes(&[floor, wall]);
    let eye = (foot.as_dvec3() + ahead * (size * 1e-3)).as_vec3();
    let (shape, surface) = stages.surface(rounded_ray(eye, foot.as_dvec3() - eye.as_dvec3()))?;
    let shadow = stages.shadow(surface, light).filter(|_| shape == 0)?;
    let before = |point: DVec3| side_of_plane(point, wall) == Ordering::Greater;
    let distance = (light - shadow.origin.as_dvec3()).length();
    let clear = depth(light, wall) >= standing.min * distance;
    (before(light) && before(shadow.origin.as_dvec3()) && clear).then_some((shadow, wall, distance))
}

/// How far a point stands before a plane, about.
fn depth(point: DVec3, plane: Plane) -> f64 {
    plane.normal.dot(point) - plane.offset
}

fn check_balls(range: Range<u64>) -> Tally {
    let (mut tally, mut stages) = (Tally::new(BALL.len()), ShadowStages::of_spheres());
    for index in range {
        let mut draws = Draws::new(63, index);
        let (ray, body) = seen_sphere_of_any_size(64, index);
        stages.spheres(&[body]);
        let Some((_, surface)) = stages.surface(ray) else {
            tally.count(false);
            continue;
        };
        let radius = body.radius * draws.power_of_ten(-3.0, 0.0);
        let away = leaving(&mut draws, surface.normal, 0.5).normalize();
        let ball = Sphere { centre: surface.position.as_dvec3() + away * (3.0 * radius), radius };
        stages.spheres(&[body, ball]);
        let light = surface.position.as_dvec3() + away * (6.0 * radius);
        // A ball that is not well larger than the bound is smaller than what f32 can tell apart there.
        let shadow = stages.shadow(surface, light).filter(|_| radius >= 64.0 * f64::from(surface.bound));
        tally.count(shadow.is_some());
        let Some(shadow) = shadow else { continue };
        tally.scores[0].check(shadow.blocked == Some(1));
        check_naive_balls(surface, shadow.direction, ball, &mut tally.scores[1..]);
    }
    tally
}

/// Whether the ball still shadows the naive starts; their kernel is exact, so that only the start is checked.
fn check_naive_balls(surface: Surface, direction: Vec3, ball: Sphere, scores: &mut [Score]) {
    let shadowed = |start: ShadowStart| {
        line_ts(start.origin, direction, ball).is_some_and(|[_, far]| far > f64::from(start.t_min))
    };
    scores[0].check(shadowed(start_after_constant(surface.position)));
    scores[1].check(shadowed(start_off_surface(surface.position, surface.normal)));
}
