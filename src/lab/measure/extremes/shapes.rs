//! Every registered shape alike, beside what the textbooks have for it: rays on both sides of its silhouette from afar,
//! grazing rays, rays from the eye at any size, rays along axes; its normals; and rays that leave it.
//!
//! A ray is misjudged where a method and exact arithmetic differ in hit or miss, or in t by more than 2u.
//! One that leaves a surface hits it again at once where it starts on the wrong side of it, or where the kernel finds
//! what exact arithmetic does not; off a planar surface, and off the outside of a convex one, any hit is such a one.

use super::shadow_stages::leaving;
use super::{Group, Method, Tally, Trial};
use crate::measure::draws::Draws;
use crate::measure::exact::UNIT_ROUNDOFF_F32 as U;
use crate::measure::naive_hits::NaiveNormal;
use crate::measure::oracle::Oracle;
use crate::measure::ray_aim::{AimedRay, rounded_ray};
use crate::measure::specimen::{Specimen, kernel_ts};
use crate::naive::shadow::{start_after_constant, start_at_hit, start_off_surface};
use glam::{DVec3, Vec3};
use pinhole::scene::Placement;
use pinhole::shapes::{offset_origin, with_shapes};
use std::ops::Range;

/// How far t may be off, relative to itself, in u.
const T_BOUND: f64 = 2.0;
/// How often a shape and a ray are drawn anew where there is nothing to check.
const ATTEMPTS: u32 = 1000;
/// A ray is to leave a surface only where there is as much room before it, in bounds of its hit.
const ROOM: f64 = 16.0;
/// Shapes and rays that the kernel gets at once.
const TOGETHER: u64 = 32;

const TOGETHER_ROWS: [Method; 4] = [
    Method::pinhole("pinhole, the closest of 32, every bit", "", 0.0),
    Method::pinhole("pinhole, no hit of a ray that is none", "", 0.0),
    Method::pinhole("pinhole, ends at 1e30 or nowhere, alike", "", 0.0),
    Method::pinhole("pinhole, directions 2^-60 to 2^60 long", "u of t", T_BOUND),
];
const LEAVING: [Method; 5] = [
    Method::pinhole("pinhole, starts on the side it leaves", "", 0.0),
    Method::pinhole("pinhole, hits only what is there", "u of t", T_BOUND),
    Method::naive("naive, at the hit", "", 0.0),
    Method::naive("naive, t > 1e-3", "", 0.0),
    Method::naive("naive, hit + 1e-4 n", "", 0.0),
];

/// The cases of rays that hit, and of normals.
pub fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    macro_rules! all {
        ($($kind:ident($shape:ty) $field:ident $plural:literal,)+) => {
            $(add_hits::<$shape>($plural, &mut trials);)+
        };
    }
    with_shapes!(all);
    trials
}

/// The cases of rays that leave.
pub fn leaving_trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    macro_rules! all {
        ($($kind:ident($shape:ty) $field:ident $plural:literal,)+) => {
            $(add_leaving::<$shape>($plural, &mut trials);)+
        };
    }
    with_shapes!(all);
    trials
}

fn add_hits<S: Oracle>(plural: &str, trials: &mut Vec<Trial>) {
    let first = Specimen::<S>::drawn(&mut Draws::new(601, 0), [0.0, 0.0], 1.0);
    let is_finite = first.is_some_and(|specimen| specimen.shape.bounds().is_some());
    let mut add = |what: &str, bound: f64, seed: u64, draw: fn(&mut Draws) -> Option<Shot<S>>| {
        let naive = S::naive_hits();
        let naive = naive.iter().map(|naive| Method::naive(naive.name, "u of t", bound));
        let rows: Vec<Method> = [Method::pinhole("pinhole", "u of t", bound)].into_iter().chain(naive).collect();
        let check = move |range| check_hits::<S>(seed, draw, range);
        trials.push(Trial::new(Group::Shapes, format!("{plural}: {what}"), &rows, check));
    };
    if is_finite {
        add("silhouettes from 1e3 radii", T_BOUND, 611, |draws| at_silhouette(draws, 1e3));
        add("silhouettes from 1e5 radii", T_BOUND, 612, |draws| at_silhouette(draws, 1e5));
        add("silhouettes from 1e7 radii", T_BOUND, 613, |draws| at_silhouette(draws, 1e7));
    }
    add("from the eye, any size 1e-8 to 1e8", T_BOUND, 614, from_the_eye);
    add("grazing from anywhere, any size 1e-8 to 1e8", S::FROM_ANYWHERE, 615, grazing);
    if S::TELLS_TOUCHING {
        add("along axes, zeros of both signs", S::FROM_ANYWHERE, 616, along_axes);
    }
    let together = check_together::<S>;
    trials.push(Trial::new(Group::Shapes, format!("{plural}: 32 rays and 32 of them"), &TOGETHER_ROWS, together));
    if let Some(naive) = S::naive_normal() {
        let rows = [
            Method::pinhole("pinhole, normal, angle to the exact one", "u", 4.0),
            Method::pinhole("pinhole, normal, its length", "u", 4.0),
            Method::naive(naive.name, "u", 4.0),
        ];
        let name = format!("{plural}: normals where they are seen at their edge");
        trials.push(Trial::new(Group::Shapes, name, &rows, move |range| check_normals::<S>(&naive, range)));
    }
}

fn add_leaving<S: Oracle>(plural: &str, trials: &mut Vec<Trial>) {
    let mut add = |what: &str, inside: bool, rows: &[Method]| {
        let name = format!("{plural}: rays that leave {what}, sizes 1e-8 to 1e8");
        let count = rows.len();
        trials.push(Trial::new(Group::Shadow, name, rows, move |range| check_leaving::<S>(inside, count, range)));
    };
    // Where a ray may well hit the shape again, only exact sides tell a start from a wrong one.
    add("them", false, if S::IS_PLANAR || S::IS_CONVEX { &LEAVING } else { &LEAVING[..2] });
    if !S::IS_PLANAR {
        add("their inside", true, &LEAVING[..2]);
    }
}

/// A shape and a ray at it.
type Shot<S> = (Specimen<S>, AimedRay);

/// What is found at one of many attempts.
fn found<T>(draws: &mut Draws, mut attempt: impl FnMut(&mut Draws) -> Option<T>) -> Option<T> {
    (0..ATTEMPTS).find_map(|_| attempt(draws))
}

fn check_hits<S: Oracle>(seed: u64, draw: fn(&mut Draws) -> Option<Shot<S>>, range: Range<u64>) -> Tally {
    let naive = S::naive_hits();
    let mut tally = Tally::new(1 + naive.len());
    for index in range {
        let shot = found(&mut Draws::new(seed, index), draw);
        tally.count(shot.is_some());
        let Some((specimen, ray)) = shot else { continue };
        let (shape, exact) = (&specimen.shape, specimen.shape.exact_t(ray));
        tally.scores[0].check_t(specimen.kernel_t(ray), exact);
        for (score, naive) in tally.scores[1..].iter_mut().zip(&naive) {
            let seen = (naive.seen)(shape);
            let exact = if seen == *shape { exact } else { seen.exact_t(ray) };
            score.check_t((naive.t)(&seen, ray), exact);
        }
    }
    tally
}

/// One of two rays from the eye, as near to one another as f32 allows, of which one hits the shape and the other misses
/// it.
fn at_silhouette<S: Oracle>(draws: &mut Draws, away: f64) -> Option<Shot<S>> {
    let specimen = Specimen::<S>::drawn_stretched(draws, [-1.0, 1.0], away)?;
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
    let ray = ray(if draws.unit() < 0.5 { inside } else { outside });
    Some((specimen, ray))
}

/// A ray from the eye to somewhere on a shape of any size.
fn from_the_eye<S: Oracle>(draws: &mut Draws) -> Option<Shot<S>> {
    let away = draws.power_of_ten(-2.0, 4.0);
    let specimen = Specimen::<S>::drawn_stretched(draws, [-8.0, 8.0], away)?;
    let ray = rounded_ray(Vec3::ZERO, specimen.aim(draws));
    Some((specimen, ray))
}

/// A ray from anywhere to a point of the surface, at a slope down to 1e-8; where f32 is too coarse it may miss.
fn grazing<S: Oracle>(draws: &mut Draws) -> Option<Shot<S>> {
    let (specimen, seen) = from_the_eye::<S>(draws)?;
    let hit = specimen.hit(seen.origin.as_dvec3(), seen.direction.as_dvec3())?;
    let surface = specimen.shape.surface(&specimen.surface_data, &hit);
    let away = specimen.sphere_around().1 * draws.power_of_ten(-2.0, 4.0);
    let origin = (surface.point + leaving(draws, surface.normal.as_vec3(), 8.0) * away).as_vec3();
    let towards = surface.point - origin.as_dvec3();
    (towards.length() > 0.0).then(|| (specimen, rounded_ray(origin, towards)))
}

/// A shape that is not turned, on a grid of eighths, and a ray through a point of the grid along an axis, or all but: by
/// parts of 0 with either sign.
fn along_axes<S: Oracle>(draws: &mut Draws) -> Option<Shot<S>> {
    let scale = libm::ldexp(1.0, draws.between(-20.0, 21.0).floor() as i32);
    let grid = |draws: &mut Draws, max: f64| DVec3::from([(); 3].map(|()| draws.between(-max, max + 1.0).floor()));
    let (position, point) = (grid(draws, 8.0) * (scale / 8.0), grid(draws, 4.0) * (scale / 4.0));
    let non_uniform = if S::NON_UNIFORM == Some(true) { DVec3::new(1.0, 0.5, 2.0) } else { DVec3::ONE };
    let placement = Placement { position, scale: non_uniform * scale, ..Placement::default() };
    let specimen = Specimen::<S>::of(S::Component::default(), placement)?;
    let mut zero = || if draws.unit() < 0.5 { 0.0 } else { -0.0 };
    let mut direction = Vec3::new(zero(), zero(), zero());
    let first = (draws.unit() * 3.0) as usize;
    direction[first] = if draws.unit() < 0.5 { 1.0 } else { -1.0 };
    if draws.unit() < 0.3 {
        direction[(first + 1) % 3] = if draws.unit() < 0.5 { 0.5 } else { -1.0 };
    }
    let origin = (position + point).as_vec3() - direction * (4.0 * scale as f32);
    Some((specimen, AimedRay { origin, direction }))
}

/// Rays and shapes all at once, one of the rays without a direction, infinite or NaN.
fn check_together<S: Oracle>(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(TOGETHER_ROWS.len());
    let indices: Vec<u64> = range.collect();
    for indices in indices.chunks(TOGETHER as usize) {
        let mut draws = Draws::new(617, indices[0]);
        let shots = indices.iter().filter_map(|&index| found(&mut Draws::new(618, index), from_the_eye::<S>));
        let shots: Vec<Shot<S>> = shots.collect();
        if shots.is_empty() {
            continue;
        }
        let shapes: Vec<S> = shots.iter().map(|(specimen, _)| specimen.shape.clone()).collect();
        let mut rays: Vec<AimedRay> = shots.iter().map(|&(_, ray)| ray).collect();
        let (none, part) = ((draws.unit() * rays.len() as f64) as usize, (draws.unit() * 3.0) as usize);
        match (draws.unit() * 4.0) as usize {
            0 => rays[none].direction = Vec3::ZERO,
            1 => rays[none].direction[part] = f32::NAN,
            2 => rays[none].direction[part] = f32::INFINITY,
            _ => rays[none].origin[part] = f32::NAN,
        }
        let [closest, ending] = [f64::INFINITY, 1e30].map(|t_max| kernel_ts(&shapes, &rays, t_max));
        for (row, (specimen, &ray)) in shots.iter().map(|shot| &shot.0).zip(&rays).enumerate() {
            tally.count(true);
            tally.scores[2].check(closest[row] == ending[row]);
            if row == none {
                tally.scores[1].check(closest[row].is_none());
                continue;
            }
            let each =
                shapes.iter().filter_map(|shape| kernel_ts(std::slice::from_ref(shape), &[ray], f64::INFINITY)[0]);
            let nearest = each.reduce(f64::min);
            tally.scores[0].check(closest[row].map(f64::to_bits) == nearest.map(f64::to_bits));
            let scale = libm::ldexp(1.0, draws.between(-60.0, 61.0).floor() as i32);
            let longer = AimedRay { direction: ray.direction * scale as f32, ..ray };
            let (t, exact) = (specimen.kernel_t(longer), specimen.shape.exact_t(longer));
            tally.scores[3].check_t(t, exact);
        }
    }
    tally
}

fn check_normals<S: Oracle>(naive: &NaiveNormal<S>, range: Range<u64>) -> Tally {
    let mut tally = Tally::new(3);
    for index in range {
        let checked = found(&mut Draws::new(619, index), |draws| {
            let (specimen, ray) = grazing::<S>(draws)?;
            let hit = specimen.hit(ray.origin.as_dvec3(), ray.direction.as_dvec3())?;
            let normal = specimen.shape.surface(&specimen.surface_data, &hit).normal.as_vec3();
            let naive = (naive.normal)(&specimen.shape, ray, hit.t);
            let facing = if naive.dot(ray.direction) > 0.0 { -naive } else { naive };
            Some((normal, specimen.shape.normal_angles(ray, [normal, facing])?))
        });
        tally.count(checked.is_some());
        let Some((normal, [pinhole, naive])) = checked else { continue };
        tally.scores[0].measure(pinhole);
        tally.scores[1].measure((normal.as_dvec3().length() - 1.0).abs() / U);
        tally.scores[2].measure(naive);
    }
    tally
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
    /// The hit that it leaves, and the normal there.
    hit: [Vec3; 2],
}

fn check_leaving<S: Oracle>(inside: bool, rows: usize, range: Range<u64>) -> Tally {
    let mut tally = Tally::new(rows);
    for index in range {
        let mut draws = Draws::new(621 + u64::from(inside), index);
        let left = found(&mut draws, |draws| {
            let away = draws.power_of_ten(-2.0, 4.0);
            let specimen = Specimen::<S>::drawn(draws, [-8.0, 8.0], away)?;
            let left = left(&specimen, inside, draws)?;
            Some((specimen, left))
        });
        tally.count(left.is_some());
        let Some((specimen, Left { ray, side, never_again, arrived, hit })) = left else { continue };
        tally.scores[0].check(arrived && specimen.shape.exact_side(ray.origin.as_dvec3()) == side);
        let (t, exact) = (specimen.kernel_t(ray), specimen.shape.exact_t(ray));
        tally.scores[1].check_t(t, exact);
        tally.scores[1].check(!never_again || (t.is_none() && exact.is_none()));
        if never_again {
            let [position, normal] = hit;
            let starts = [start_at_hit(position), start_after_constant(position), start_off_surface(position, normal)];
            for (score, start) in tally.scores[2..].iter_mut().zip(starts) {
                // Their kernel is exact, so that only the start is checked.
                let again = specimen.shape.exact_t(AimedRay { origin: start.origin, ..ray });
                score.check(again.is_none_or(|t| t <= f64::from(start.t_min)));
            }
        }
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
    let surface = shape.surface(&specimen.surface_data, &hit);
    let (normal, bound) = (surface.normal.as_vec3(), surface.bound);
    let side = if shape.parts_space() { from } else { 2 * i32::from(surface.outside) - 1 };
    let room = surface.point + surface.normal * (ROOM * f64::from(bound));
    if shape.exact_side(room) != side {
        return None;
    }
    let position = surface.point.as_vec3();
    let start = offset_origin(position, normal, bound);
    Some(Left {
        ray: rounded_ray(start, leaving(draws, normal, 6.0)),
        side,
        never_again: S::IS_PLANAR || (S::IS_CONVEX && surface.outside),
        arrived: S::IS_PLANAR || surface.outside == (side > 0),
        hit: [position, normal],
    })
}
