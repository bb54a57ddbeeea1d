//! Rays against stretched spheres: silhouettes, tips and flanks of needles and pancakes, from near and far.

use super::bench::Bench;
use super::sphere::T_BOUND;
use super::transform_aim::{From, SampleLights, Stretched, View, ellipsoid_table, shot};
use super::{Group, Method, Score, Tally, Trial};
use super::{transform_placement, transform_surface};
use crate::measure::oracle_ellipsoid;
use crate::measure::ray_aim::AimedRay;
use crate::naive::ellipsoid::{hit_f32, hit_renormalised};
use pinhole::intersect::{Hits, ellipsoid_stage, start_stage};
use pinhole::shapes::{Ellipsoid, ellipsoid_t};
use std::ops::Range;

/// Ellipsoids and rays that the stage gets at once.
const AMONG: usize = 32;

const METHODS: [Method; 4] = [
    Method::pinhole("pinhole, one ellipsoid and one ray", "u of t", T_BOUND),
    Method::pinhole("pinhole, 32 ellipsoids and 32 rays", "u of t", T_BOUND),
    Method::naive("naive, unit direction in the object", "u of t", T_BOUND),
    Method::naive("naive b2 - 4ac in the object, f32", "u of t", T_BOUND),
];

/// The cases of the group.
pub fn trials() -> Vec<Trial> {
    let views = [
        ("silhouette, 10 times as long, 1e3 radii away", 1.0, 0.0, SampleLights::Silhouette, From::Far(1e3)),
        ("silhouette, 1e3 times as long, 1e5 radii away", 3.0, 0.0, SampleLights::Silhouette, From::Far(1e5)),
        ("silhouette, 1e4 times as long, 1e7 radii away", 4.0, 0.0, SampleLights::Silhouette, From::Far(1e7)),
        ("silhouette, 1e7 times as long, any size 1e-8 to 1e8", 7.0, 8.0, SampleLights::Silhouette, From::Far(2.0)),
        ("silhouette, 1e7 times as long, 1e7 radii away", 7.0, 0.0, SampleLights::Silhouette, From::Far(1e7)),
        ("tips and poles, 1e4 times as long, 1e3 radii away", 4.0, 0.0, SampleLights::Pole, From::Far(1e3)),
        ("tips and poles, 1e7 times as long, from near", 7.0, 8.0, SampleLights::Pole, From::Near(-6.0)),
        ("anywhere, 1e4 times as long, any size, 1e3 radii away", 4.0, 8.0, SampleLights::Anywhere, From::Far(1e3)),
        ("anywhere, 1e7 times as long, any size, from near", 7.0, 8.0, SampleLights::Anywhere, From::Near(-6.0)),
    ];
    let trial = |(seed, (name, ratio, sizes, aim, from)): (u64, (&str, f64, f64, SampleLights, From))| {
        let view = View { seed, ratio, sizes, aim, from };
        Trial::new(Group::Transform, name, &METHODS, move |range| check(view, range))
    };
    let mut trials: Vec<Trial> = (91..).zip(views).map(trial).collect();
    trials.extend(transform_surface::trials());
    trials.extend(transform_placement::trials());
    trials
}

fn check(view: View, range: Range<u64>) -> Tally {
    let mut tally = Tally::new(METHODS.len());
    let mut bench = Bench::new(&[start_stage(), ellipsoid_stage()]);
    let shots: Vec<(AimedRay, Stretched)> = range.map(|index| shot(view, index)).collect();
    for shots in shots.chunks(AMONG) {
        let exact: Vec<Option<f64>> = shots.iter().map(|(ray, shape)| exact(*ray, &shape.ellipsoid)).collect();
        for ((ray, shape), &exact) in shots.iter().zip(&exact) {
            tally.count(exact.is_some());
            check_alone(&mut bench, *ray, shape.ellipsoid, exact, &mut tally.scores[0]);
            check_naive(*ray, shape.ellipsoid, exact, &mut tally.scores[2..]);
        }
        check_among(&mut bench, shots, &exact, &mut tally.scores[1]);
    }
    tally
}

/// The exact distance, rounded to f64 once.
fn exact(ray: AimedRay, ellipsoid: &Ellipsoid) -> Option<f64> {
    oracle_ellipsoid::ellipsoid_t(ray.origin, ray.direction, ellipsoid)
}

fn by_function(ray: AimedRay, ellipsoid: &Ellipsoid) -> f64 {
    ellipsoid_t(ray.origin.as_dvec3(), ray.direction.as_dvec3(), ellipsoid)
}

/// One ray and one ellipsoid through the stage: no neighbour can save a ray from being culled.
fn check_alone(bench: &mut Bench, ray: AimedRay, ellipsoid: Ellipsoid, exact: Option<f64>, score: &mut Score) {
    bench.insert(ellipsoid_table([ellipsoid]));
    bench.aim(&[ray]);
    bench.run();
    let t = bench.column::<Hits>().t[0];
    score.check(t.to_bits() == by_function(ray, &ellipsoid).to_bits());
    score.check_t(Some(t).filter(|t| t.is_finite()), exact);
}

/// All at once through the stage, against every ray with every ellipsoid by pinhole's function, to the last bit.
fn check_among(bench: &mut Bench, shots: &[(AimedRay, Stretched)], exact: &[Option<f64>], score: &mut Score) {
    bench.insert(ellipsoid_table(shots.iter().map(|(_, shape)| shape.ellipsoid)));
    let rays: Vec<AimedRay> = shots.iter().map(|(ray, _)| *ray).collect();
    bench.aim(&rays);
    bench.run();
    let hits = bench.column::<Hits>();
    for (row, &ray) in rays.iter().enumerate() {
        let nearest = shots.iter().map(|(_, shape)| by_function(ray, &shape.ellipsoid)).fold(f64::INFINITY, f64::min);
        score.check(hits.t[row].to_bits() == nearest.to_bits());
        if hits.shape[row] == row as u32 {
            score.check_t(Some(hits.t[row]), exact[row]);
        }
    }
}

/// The naive methods; the one in f32 is checked on the ellipsoid that f32 can hold.
fn check_naive(ray: AimedRay, ellipsoid: Ellipsoid, exact_f64: Option<f64>, scores: &mut [Score]) {
    let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    scores[0].check_t(hit_renormalised(origin, direction, ellipsoid.centre, ellipsoid.unit_from_world), exact_f64);
    let (centre, map) = (ellipsoid.centre.as_vec3(), ellipsoid.unit_from_world.as_mat3());
    let rounded = Ellipsoid { centre: centre.as_dvec3(), unit_from_world: map.as_dmat3(), ..ellipsoid };
    let naive = hit_f32(ray.origin, ray.direction, centre, map);
    scores[1].check_t(naive.map(f64::from), exact(ray, &rounded));
}
