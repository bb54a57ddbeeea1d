//! The self-hit offset on trial: does a shadow ray's start lie strictly on its side of the surface?
//!
//! A hit stores its position p and its unit normal n, facing the viewer, as f32, and a bound B; the
//! shadow ray starts at p' = fl(p + fl(n B)). Let o be the ray's origin, s the size of the shape's
//! numbers (|c|₁ + r, or |k|), u = 2^-24, ε = 2^-53. Claim: B = 4u|p|₁ + 2^-48 (|o|₁ + s) + 2^-146
//! puts p' strictly on the viewer's side.
//!
//! *Computing.* The f64 position P = o + t d lies off the surface by at most
//! E = 1.2 · 2^-49 (|o|₁ + s + |p|₁). An error of t moves P along the ray, and what of that leaves
//! the surface is 2^-50 |f| for the discriminant (its bound over 2r), 2^-50 |f| for f·f − r², or
//! 7ε of the largest number for a plane's two sums; the sum o + t d adds 3ε.
//!
//! *Rounding.* P to p costs u(|pᵢ| + 2^-126) a component, n B costs uB + 2^-150, p' costs
//! u(|pᵢ| + B) + 2^-150; along any unit vector that is at most 2u|p|₁ + 4uB + 2^-147. What is left
//! of B along n is at least (1 − 8u)B − 2u|p|₁ − E − 2^-147 > u|p|₁ + 2^-50 (|o|₁ + s) > 0, so that
//! the next kernel sees it too.
//!
//! *Outside.* The tangent plane at the true point has the whole sphere behind it, so to be before it
//! is to be outside. The computed n may lean by 2ε(|c| + r)/r, which matters only when r < u|p|₁,
//! and then B > 2r + 2u|p|₁ clears the sphere in every direction. *Inside* the same holds while
//! r ≥ 2B: below that no room is left to start in.

use super::exact::UNIT_ROUNDOFF_F32 as U;
use super::oracle_plane::{Plane, side_of_plane};
use super::oracle_sphere::{Sphere, side_of_sphere, sphere_hit};
use super::plane_trial::{guarded_plane, norm_1, plain_plane};
use super::ray_aim::{self, AimedRay, Draws, rounded_ray};
use super::sphere_trial::{Root, guarded_hit, perpendicular_hit, trial_rays};
use glam::{DVec3, Vec3};
use std::cmp::Ordering;

/// What a hit stores, and its f64 position before rounding.
#[derive(Clone, Copy)]
struct Point {
    exact: DVec3,
    position: Vec3,
    normal: Vec3,
    /// |o|₁ + s: the largest numbers that went into the position.
    numbers: f64,
}

/// B with `multiple` in place of 4, and with or without the part of the f64 computation.
fn bound(point: &Point, multiple: f64, with_numbers: bool) -> f32 {
    let computing = 2f64.powi(-48) * point.numbers + 2f64.powi(-146);
    let rounding = multiple * U * norm_1(point.exact);
    (rounding + if with_numbers { computing } else { 0.0 }) as f32
}

fn facing(ray: AimedRay, numbers: f64, exact: DVec3, outward: DVec3) -> Point {
    let direction = ray.direction.as_dvec3();
    // A sphere below the spacing of its own place may have no normal left, and any direction serves
    // it.
    let outward = outward.try_normalize().unwrap_or(-direction);
    let normal = if outward.dot(direction) > 0.0 { -outward } else { outward };
    Point { exact, position: exact.as_vec3(), normal: normal.as_vec3(), numbers }
}

fn sphere_point(ray: AimedRay, sphere: Sphere, t: f64) -> Point {
    let exact = ray.origin.as_dvec3() + ray.direction.as_dvec3() * t;
    let numbers = norm_1(ray.origin.as_dvec3()) + norm_1(sphere.centre) + sphere.radius;
    facing(ray, numbers, exact, exact - sphere.centre)
}

fn plane_point(ray: AimedRay, plane: Plane, t: f64) -> Point {
    let exact = ray.origin.as_dvec3() + ray.direction.as_dvec3() * t;
    facing(ray, norm_1(ray.origin.as_dvec3()) + plane.offset.abs(), exact, plane.normal)
}

/// How often each way of starting fails over one class: p' not strictly on the viewer's side.
#[derive(Default, Debug)]
struct Failures {
    starts: u64,
    no_room: u64,
    bare: u64,
    constant: u64,
    once: u64,
    twice: u64,
    only_4u: u64,
    full: u64,
    self_hits: u64,
}

impl Failures {
    /// Counts one point; `beyond` judges a start exactly.
    fn count(&mut self, point: &Point, beyond: impl Fn(Vec3) -> bool) -> Vec3 {
        let start = |b: f32| point.position + point.normal * b;
        let fails = |b: f32| u64::from(!beyond(start(b)));
        self.starts += 1;
        self.bare += fails(0.0);
        self.constant += fails(1e-4);
        self.once += fails(bound(point, 1.0, true));
        self.twice += fails(bound(point, 2.0, true));
        self.only_4u += fails(bound(point, 4.0, false));
        self.full += fails(bound(point, 4.0, true));
        start(bound(point, 4.0, true))
    }

    /// Prints the counts, and answers whether every start with the full bound was good.
    fn report(&self, name: &str, rays: u64) -> bool {
        let Self { starts, no_room, bare, constant, once, twice, only_4u, full, self_hits } = self;
        eprintln!(
            "{name}: {rays} rays, {starts} starts ({no_room} without room); not beyond: {bare} bare, {constant} 1e-4, \
             {once} 1u, {twice} 2u, {only_4u} 4u without f64 part, {full} full; {self_hits} self-hits"
        );
        (*full, *self_hits) == (0, 0)
    }
}

/// A direction anywhere above the point's own tangent plane, as f32, often nearly along it.
fn leaving(draws: &mut Draws, normal: Vec3) -> Vec3 {
    let normal = normal.as_dvec3();
    let along = draws.unit_vector_across(normal.try_normalize().unwrap_or(DVec3::X));
    let slope = draws.power_of_ten(-6.0, 1.0);
    rounded_ray(Vec3::ZERO, along + normal * slope).direction
}

/// A kernel on trial: its nearest t > 0.
type Kernel = fn(AimedRay, Sphere) -> Option<f64>;

/// The perpendicular form in f64 alone; its t may be far off, and is to be as good a start.
fn fast(ray: AimedRay, sphere: Sphere) -> Option<f64> {
    perpendicular_hit(ray, sphere, Root::SquaresOverSum).0
}

/// The perpendicular form with its wide path.
fn guarded(ray: AimedRay, sphere: Sphere) -> Option<f64> {
    guarded_hit(ray, sphere).0
}

/// The ray from `scale` times its origin.
fn scaled(ray: AimedRay, scale: f64) -> AimedRay {
    let origin = (ray.origin.as_dvec3() * scale).as_vec3();
    AimedRay { origin, ..ray }
}

/// Whether no start of the class fails, and no shadow ray from one meets its own sphere.
fn spheres(name: &str, rays: u64, scale: f64, kernel: Kernel, case: fn(u64) -> (AimedRay, Sphere)) -> bool {
    let mut failures = Failures::default();
    for index in 0..rays {
        let (ray, sphere) = case(index);
        let ray = scaled(ray, scale);
        let sphere = Sphere { centre: sphere.centre * scale, radius: sphere.radius * scale };
        let side = side_of_sphere(ray.origin.as_dvec3(), sphere);
        if side == Ordering::Equal || sphere_hit(ray.origin, ray.direction, sphere).is_none() {
            continue;
        }
        let Some(t) = kernel(ray, sphere) else {
            continue;
        };
        let point = sphere_point(ray, sphere, t);
        if side == Ordering::Less && sphere.radius < 2.0 * f64::from(bound(&point, 4.0, true)) {
            failures.no_room += 1;
            continue;
        }
        let origin = failures.count(&point, |start| side_of_sphere(start.as_dvec3(), sphere) == side);
        let direction = leaving(&mut Draws::new(31, index), point.normal);
        let touches = sphere_hit(origin, direction, sphere).is_some();
        let shadow = kernel(AimedRay { origin, direction }, sphere).is_some();
        // Inside, a leaving ray does meet the far side; the kernel is to say what the oracle says.
        failures.self_hits += u64::from(shadow != touches || (touches && side == Ordering::Greater));
    }
    failures.report(name, rays)
}

/// Whether no start of the class fails, and no shadow ray from one meets its own plane.
fn planes(
    name: &str,
    rays: u64,
    scale: f64,
    kernel: fn(AimedRay, Plane) -> Option<f64>,
    case: impl Fn(u64) -> (AimedRay, Plane),
) -> bool {
    let mut failures = Failures::default();
    for index in 0..rays {
        let (ray, plane) = case(index);
        let ray = scaled(ray, scale);
        let plane = Plane { offset: plane.offset * scale, ..plane };
        let side = side_of_plane(ray.origin.as_dvec3(), plane);
        // A hit beyond what f32 can hold is no point to start from.
        let Some(t) = kernel(ray, plane).filter(|t| *t < 1e30) else {
            continue;
        };
        let point = plane_point(ray, plane, t);
        let origin = failures.count(&point, |start| side_of_plane(start.as_dvec3(), plane) == side);
        let direction = leaving(&mut Draws::new(32, index), point.normal);
        let shadow = AimedRay { origin, direction };
        failures.self_hits += u64::from(kernel(shadow, plane).is_some());
    }
    failures.report(name, rays)
}

#[test]
fn trial_of_the_offset_on_spheres() {
    let rays = trial_rays(1000);
    let classes: [(&str, fn(u64) -> (AimedRay, Sphere)); 4] = [
        ("of any size and place", |index| ray_aim::sphere_of_any_size(41, index)),
        ("of any size, seen", |index| ray_aim::seen_sphere_of_any_size(42, index)),
        ("at the silhouette, 1e5 radii", |index| ray_aim::silhouette(43, index, 1e5)),
        ("at the horizon", |index| ray_aim::horizon(44, index, 1e6, 1.0)),
    ];
    for scale in [1.0, 2f64.powi(-100), 2f64.powi(-130)] {
        for (class, case) in classes {
            let name = format!("spheres {class}, x{scale:.1e}");
            // Where the eye itself stands within ε of a surface, f64 may take the wrong root.
            spheres(&format!("{name}, f64"), rays, scale, fast, case);
            let guarded = spheres(&format!("{name}, guarded"), rays, scale, guarded, case);
            assert!(guarded, "{name}");
        }
    }
}

#[test]
fn trial_of_the_offset_on_planes() {
    let rays = trial_rays(1000);
    for (scale, flattest) in [(1.0, 0.0), (1.0, 4.0), (1.0, 12.0), (2f64.powi(-100), 8.0), (2f64.powi(-130), 8.0)] {
        let name = format!("planes, slope from 1e-{flattest}, x{scale:.1e}");
        let case = |index| ray_aim::plane_of_any_offset(45, index, flattest);
        assert!(planes(&format!("{name}, f64"), rays, scale, plain_plane, case));
        assert!(planes(&format!("{name}, guarded"), rays, scale, guarded_plane, case));
    }
}
