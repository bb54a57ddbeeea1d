//! Rays against spheres: silhouettes, horizons, tangents, centres, every size.

use super::bench::{Bench, sphere_table};
use super::frame;
use super::{Group, Method, Score, Tally, Trial};
use crate::measure::oracle_sphere::{self, Sphere};
use crate::measure::ray_aim::{self, AimedRay};
use crate::naive::sphere::{hit_f32, hit_f64_plain, hit_haines_f32};
use pinhole::intersect::{Hits, sphere_stage, start_stage};
use pinhole::shapes::sphere_t;
use std::ops::Range;

/// How far t may be off, relative to itself, in u.
pub(super) const T_BOUND: f64 = 2.0;
/// Spheres and rays that the stage gets at once.
const AMONG: usize = 32;

const METHODS: [Method; 5] = [
    Method::pinhole("pinhole, a sphere and a ray at a time", "u of t", T_BOUND),
    Method::pinhole("pinhole, 32 spheres and 32 rays", "u of t", T_BOUND),
    Method::naive("naive b2 - 4ac, f32", "u of t", T_BOUND),
    Method::naive("naive perpendicular form, f32", "u of t", T_BOUND),
    Method::naive("naive b2 - ac, f64", "u of t", T_BOUND),
];

/// The cases of the group.
pub fn trials() -> Vec<Trial> {
    let mut trials = vec![
        trial("silhouette at 1e3 radii", |index| ray_aim::silhouette(21, index, 1e3)),
        trial("silhouette at 1e5 radii", |index| ray_aim::silhouette(22, index, 1e5)),
        trial("silhouette at 1e7 radii", |index| ray_aim::silhouette(23, index, 1e7)),
        trial("horizon of radius 1e6 from height 1", |index| ray_aim::horizon(24, index, 1e6, 1.0)),
        trial("horizon of radius 1e8 from height 1e-2", |index| ray_aim::horizon(25, index, 1e8, 1e-2)),
        trial("disc of radius 1e6 from height 1", |index| ray_aim::disc(26, index, 1e6, 1.0 + 1e-6)),
        trial("radius 1e-6 at 1e3, finer than directions", |index| ray_aim::disc(32, index, 1e-6, 1e9)),
        trial("tangent at 1.5 radii", |index| ray_aim::tangent(27, index, 1.0, 1.5)),
        trial("tangent at 1e3 radii", |index| ray_aim::tangent(28, index, 1.0, 1e3)),
        trial("centre at 1e5 radii", |index| ray_aim::centre(29, index, 1.0, 1e5)),
        trial("any size 1e-8 to 1e8, seen", |index| ray_aim::seen_sphere_of_any_size(30, index)),
        trial("any size and place 1e-8 to 1e8", |index| ray_aim::sphere_of_any_size(31, index)),
    ];
    trials.push(frame::trial());
    trials
}

fn trial(name: &str, aim: fn(u64) -> (AimedRay, Sphere)) -> Trial {
    Trial::new(Group::Sphere, name, &METHODS, move |range| check(aim, range))
}

fn check(aim: fn(u64) -> (AimedRay, Sphere), range: Range<u64>) -> Tally {
    let mut tally = Tally::new(METHODS.len());
    let mut bench = Bench::new(&[start_stage(), sphere_stage()]);
    let shots: Vec<(AimedRay, Sphere)> = range.map(aim).collect();
    for shots in shots.chunks(AMONG) {
        let exact: Vec<Option<f64>> = shots.iter().map(|&(ray, sphere)| exact(ray, sphere)).collect();
        for (&(ray, sphere), &exact) in shots.iter().zip(&exact) {
            tally.count(exact.is_some());
            let [alone, _, naive @ ..] = &mut tally.scores[..] else { continue };
            check_alone(&mut bench, ray, sphere, exact, alone);
            check_naive(ray, sphere, exact, naive);
        }
        check_among(&mut bench, shots, &exact, &mut tally.scores[1]);
    }
    tally
}

/// The exact distance, rounded to f64 once.
pub(super) fn exact(ray: AimedRay, sphere: Sphere) -> Option<f64> {
    oracle_sphere::sphere_t(ray.origin, ray.direction, sphere)
}

/// The distance by pinhole's function of one ray and one sphere.
pub(super) fn by_function(ray: AimedRay, sphere: Sphere) -> f64 {
    sphere_t(ray.origin.as_dvec3(), ray.direction.as_dvec3(), sphere.centre, sphere.radius)
}

/// One ray and one sphere through the stage: no neighbour in the same block can save a ray from being culled.
fn check_alone(bench: &mut Bench, ray: AimedRay, sphere: Sphere, exact: Option<f64>, score: &mut Score) {
    bench.insert(sphere_table(&[sphere]));
    bench.aim(&[ray]);
    bench.run();
    let t = bench.column::<Hits>().t[0];
    score.check(t.to_bits() == by_function(ray, sphere).to_bits());
    score.check_t(Some(t).filter(|t| t.is_finite()), exact);
}

/// All at once through the stage, against every ray with every sphere by pinhole's function, to the last bit; whoever
/// hits its own sphere is also checked by the exact distance.
fn check_among(bench: &mut Bench, shots: &[(AimedRay, Sphere)], exact: &[Option<f64>], score: &mut Score) {
    let (rays, spheres): (Vec<_>, Vec<_>) = shots.iter().copied().unzip();
    bench.insert(sphere_table(&spheres));
    bench.aim(&rays);
    bench.run();
    let hits = bench.column::<Hits>();
    for (row, &ray) in rays.iter().enumerate() {
        let nearest = spheres.iter().map(|&sphere| by_function(ray, sphere)).fold(f64::INFINITY, f64::min);
        score.check(hits.t[row].to_bits() == nearest.to_bits());
        if hits.shape[row] == row as u32 {
            score.check_t(Some(hits.t[row]), exact[row]);
        }
    }
}

/// The naive methods, each checked on the sphere that it can hold: in f32 that is the sphere rounded to f32.
fn check_naive(ray: AimedRay, sphere: Sphere, exact_f64: Option<f64>, scores: &mut [Score]) {
    let rounded = sphere.rounded_to_f32();
    let exact_f32 = if rounded == sphere { exact_f64 } else { exact(ray, rounded) };
    let (centre, radius) = (rounded.centre.as_vec3(), rounded.radius as f32);
    scores[0].check_t(hit_f32(ray.origin, ray.direction, centre, radius).map(f64::from), exact_f32);
    scores[1].check_t(hit_haines_f32(ray.origin, ray.direction, centre, radius).map(f64::from), exact_f32);
    scores[2].check_t(hit_f64_plain(ray.origin, ray.direction, sphere.centre, sphere.radius), exact_f64);
}
