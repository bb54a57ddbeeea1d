//! Every registered shape alike: rays on both sides of its silhouette from afar, and rays that leave it, of any size.
//!
//! A ray is misjudged where pinhole's kernel and exact arithmetic differ in hit or miss, or in t by more than 2u.
//! One that leaves a surface hits it again at once where it starts on the wrong side of it, or where the kernel finds
//! what exact arithmetic does not; off a planar surface, and off the outside of a convex one, any hit is such a one.

use super::shadow_stages::leaving;
use super::sphere::T_BOUND;
use super::{Group, Method, Tally, Trial};
use crate::measure::oracle::Oracle;
use crate::measure::ray_aim::{AimedRay, Draws, rounded_ray};
use crate::measure::specimen::Specimen;
use glam::Vec3;
use pinhole::shapes::{offset_origin, with_shapes};
use std::ops::Range;

/// Rows of a case of silhouettes, and of a case of rays that leave.
const SILHOUETTES: [Method; 1] = [Method::pinhole("pinhole", "u of t", T_BOUND)];
const LEAVING: [Method; 2] = [
    Method::pinhole("pinhole, starts on the side it leaves", "", 0.0),
    Method::pinhole("pinhole, hits only what is there", "u of t", T_BOUND),
];

/// How often a shape and a ray are drawn anew where there is nothing to check.
const ATTEMPTS: u32 = 1000;
/// A ray is to leave a surface only where there is as much room before it, in bounds of its hit.
const ROOM: f64 = 16.0;

/// The cases of the group.
pub fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    macro_rules! all {
        ($($kind:ident($shape:ty) $field:ident $plural:literal,)+) => {
            $(add::<$shape>($plural, &mut trials);)+
        };
    }
    with_shapes!(all);
    trials
}

fn add<S: Oracle>(plural: &str, trials: &mut Vec<Trial>) {
    let first = Specimen::<S>::drawn(&mut Draws::new(601, 0), [0.0, 0.0], 1.0);
    let is_finite = first.is_some_and(|specimen| specimen.shape.bounds().is_some());
    for (away, shown) in [(1e3, "1e3"), (1e5, "1e5"), (1e7, "1e7")] {
        if is_finite {
            let name = format!("{plural}: silhouettes from {shown} radii");
            let check = move |range| check_silhouettes::<S>(away, range);
            trials.push(Trial::new(Group::Shapes, name, &SILHOUETTES, check));
        }
    }
    let mut add_leaving = |what: &str, inside: bool| {
        let name = format!("{plural}: rays that leave {what}, sizes 1e-8 to 1e8");
        trials.push(Trial::new(Group::Shapes, name, &LEAVING, move |range| check_leaving::<S>(inside, range)));
    };
    add_leaving("them", false);
    if !S::IS_PLANAR {
        add_leaving("their inside", true);
    }
}

/// What is found at one of many attempts.
fn found<T>(draws: &mut Draws, mut attempt: impl FnMut(&mut Draws) -> Option<T>) -> Option<T> {
    (0..ATTEMPTS).find_map(|_| attempt(draws))
}

fn check_silhouettes<S: Oracle>(away: f64, range: Range<u64>) -> Tally {
    let mut tally = Tally::new(SILHOUETTES.len());
    for index in range {
        let mut draws = Draws::new(611, index);
        let ray = found(&mut draws, |draws| {
            let specimen = Specimen::<S>::drawn(draws, [-1.0, 1.0], away)?;
            let ray = at_silhouette(&specimen, draws)?;
            Some((specimen, ray))
        });
        tally.count(ray.is_some());
        if let Some((specimen, ray)) = ray {
            tally.scores[0].check_t(specimen.kernel_t(ray), specimen.shape.exact_t(ray));
        }
    }
    tally
}

/// One of two rays from the eye, as near to one another as f32 allows, of which one hits the shape and the other misses
/// it.
fn at_silhouette<S: Oracle>(specimen: &Specimen<S>, draws: &mut Draws) -> Option<AimedRay> {
    let (towards, (_, radius)) = (specimen.aim(draws), specimen.sphere_around());
    let beside = draws.unit_vector_across(towards.normalize()) * (3.0 * radius);
    let hits = |ray: AimedRay| specimen.shape.t(ray.origin.as_dvec3(), ray.direction.as_dvec3()).is_finite();
    let ray = |part: f64| rounded_ray(Vec3::ZERO, towards + beside * part);
    let (mut inside, mut outside) = (0.0, 1.0);
    if !hits(ray(inside)) || hits(ray(outside)) {
        return None;
    }
    while ray(inside) != ray(outside) && (outside - inside) > 1e-15 {
        let middle = 0.5 * (inside + outside);
        if hits(ray(middle)) { inside = middle } else { outside = middle }
    }
    Some(ray(if draws.unit() < 0.5 { inside } else { outside }))
}

/// A ray that leaves a surface, and what is known of it.
struct Left {
    ray: AimedRay,
    /// The exact side that it is to start on.
    side: i32,
    /// Whether it can hit the shape again.
    never_again: bool,
    /// Whether the hit before it was on the side on which its ray's origin lies.
    arrived: bool,
}

fn check_leaving<S: Oracle>(inside: bool, range: Range<u64>) -> Tally {
    let mut tally = Tally::new(LEAVING.len());
    for index in range {
        let mut draws = Draws::new(612 + u64::from(inside), index);
        let left = found(&mut draws, |draws| {
            let away = draws.power_of_ten(-2.0, 4.0);
            let specimen = Specimen::<S>::drawn(draws, [-8.0, 8.0], away)?;
            let left = left(&specimen, inside, draws)?;
            Some((specimen, left))
        });
        tally.count(left.is_some());
        let Some((specimen, Left { ray, side, never_again, arrived })) = left else { continue };
        tally.scores[0].check(arrived && specimen.shape.exact_side(ray.origin.as_dvec3()) == side);
        let (t, exact) = (specimen.kernel_t(ray), specimen.shape.exact_t(ray));
        tally.scores[1].check_t(t, exact);
        tally.scores[1].check(!never_again || (t.is_none() && exact.is_none()));
    }
    tally
}

/// A ray that leaves the surface where another has hit it, on the side that this has come from; none where there is no
/// room for one to start, or nothing is hit.
fn left<S: Oracle>(specimen: &Specimen<S>, inside: bool, draws: &mut Draws) -> Option<Left> {
    let shape = &specimen.shape;
    let (centre, radius) = specimen.sphere_around();
    let far = centre + draws.unit_vector() * (radius * draws.power_of_ten(0.1, 2.0));
    let origin = if inside { specimen.aim(draws) } else { far }.as_vec3();
    let from = shape.exact_side(origin.as_dvec3());
    if inside && from >= 0 {
        return None;
    }
    let towards = if inside { draws.unit_vector() } else { specimen.aim(draws) - origin.as_dvec3() };
    let arriving = rounded_ray(origin, towards);
    let hit = specimen.hit(arriving.origin.as_dvec3(), arriving.direction.as_dvec3())?;
    let surface = shape.surface(&specimen.beside, &hit);
    let (normal, bound) = (surface.normal.as_vec3(), surface.bound);
    let side = if shape.parts_space() { from } else { 2 * i32::from(surface.outside) - 1 };
    let room = surface.point + surface.normal * (ROOM * f64::from(bound));
    if shape.exact_side(room) != side {
        return None;
    }
    let start = offset_origin(surface.point.as_vec3(), normal, bound);
    Some(Left {
        ray: rounded_ray(start, leaving(draws, normal, 6.0)),
        side,
        never_again: S::IS_PLANAR || (S::IS_CONVEX && surface.outside),
        arrived: S::IS_PLANAR || surface.outside == (side > 0),
    })
}
