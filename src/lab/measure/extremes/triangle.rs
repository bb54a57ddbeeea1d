//! Rays against triangles: edges, corners, slivers, flat views, every size.

use super::bench::Bench;
use super::triangle_aim::{Corners, From, SampleLights, View, shot, triangle_table};
use super::{Group, Method, Score, Tally, Trial};
use super::{triangle_limits, triangle_mesh, triangle_surface};
use crate::measure::oracle_triangle;
use crate::measure::ray_aim::AimedRay;
use crate::naive::triangle::{hit_f32, hit_woop_f32};
use pinhole::intersect::{Hits, start_stage, triangle_stage};
use pinhole::shapes::{TriangleRow, triangle_t};
use std::ops::Range;

/// Triangles and rays that the stage gets at once.
const AMONG: usize = 32;
/// Rays of the cases beside those that the floor of a million is about: closed meshes, any place, shadow rays.
pub(super) const BESIDE: u64 = 100_000;
/// How far t may be off, relative to itself, in u.
pub(super) const T_BOUND: f64 = 1.0;

const METHODS: [Method; 4] = [
    Method::pinhole("pinhole, a triangle and a ray at a time", "u of t", T_BOUND),
    Method::pinhole("pinhole, 32 triangles and 32 rays", "u of t", T_BOUND),
    Method::naive("naive Moller-Trumbore, 1e-6, f32", "u of t", T_BOUND),
    Method::naive("Woop as published, f32, f64 at 0", "u of t", T_BOUND),
];

/// The seed of the case that is tried in full.
const ANY_PLACE: u64 = 204;

/// The cases of the group.
pub fn trials() -> Vec<Trial> {
    let views = [
        ("seen from the eye, any size 1e-8 to 1e8", 0.0, SampleLights::Inside, From::Eye(3.0)),
        ("edges from the eye, 1 to 1e3 edges away", 0.0, SampleLights::Edge, From::Eye(3.0)),
        ("edges from the eye, 1 to 1e7 edges away", 0.0, SampleLights::Edge, From::Eye(7.0)),
        ("edges and places 1e-8 to 1e8", 0.0, SampleLights::Edge, From::Anywhere(0.0)),
        ("corners and places 1e-8 to 1e8", 0.0, SampleLights::Corner, From::Anywhere(0.0)),
        ("any place, slope from 1e-12", 0.0, SampleLights::Inside, From::Anywhere(12.0)),
        ("slivers, 1e-10 as high as long, their edges", 10.0, SampleLights::Edge, From::Eye(3.0)),
        ("slivers, any place, slope from 1e-6", 10.0, SampleLights::Inside, From::Anywhere(6.0)),
    ];
    let trial = |(seed, (name, thinnest, aim, from)): (u64, (&str, f64, SampleLights, From))| {
        let view = View { seed, thinnest, aim, from };
        let trial = Trial::new(Group::Triangle, name, &METHODS, move |range| check(view, range));
        if seed == ANY_PLACE { trial } else { trial.at_most(BESIDE) }
    };
    let mut trials: Vec<Trial> = (201..).zip(views).map(trial).collect();
    trials.extend(triangle_mesh::trials());
    trials.extend(triangle_surface::trials());
    trials.extend(triangle_limits::trials());
    trials
}

fn check(view: View, range: Range<u64>) -> Tally {
    let mut tally = Tally::new(METHODS.len());
    let mut bench = Bench::new(&[start_stage(), triangle_stage()]);
    let shots: Vec<(AimedRay, Corners)> = range.map(|index| shot(view, index)).collect();
    for shots in shots.chunks(AMONG) {
        let truths: Vec<Option<f64>> = shots.iter().map(|&(ray, corners)| exact(ray, corners)).collect();
        for (&(ray, corners), &exact) in shots.iter().zip(&truths) {
            tally.count(exact.is_some());
            check_alone(&mut bench, ray, corners, exact, &mut tally.scores[0]);
            check_naive(ray, corners, exact, &mut tally.scores[2..]);
        }
        check_among(&mut bench, shots, &truths, &mut tally.scores[1]);
    }
    tally
}

/// The exact distance, rounded to f64 once.
pub(super) fn exact(ray: AimedRay, corners: Corners) -> Option<f64> {
    oracle_triangle::triangle_t(ray.origin, ray.direction, corners)
}

/// The distance by pinhole's function of one ray and one triangle.
pub(super) fn by_function(ray: AimedRay, triangle: &TriangleRow) -> f64 {
    triangle_t(ray.origin.as_dvec3(), ray.direction.as_dvec3(), triangle)
}

/// One ray and one triangle through the stage: no neighbour can save a ray from being culled.
fn check_alone(bench: &mut Bench, ray: AimedRay, corners: Corners, exact: Option<f64>, score: &mut Score) {
    bench.insert(triangle_table([corners]));
    bench.aim(&[ray]);
    bench.run();
    let t = bench.column::<Hits>().t[0];
    score.check(t.to_bits() == by_function(ray, &TriangleRow::new(corners)).to_bits());
    score.check_t(Some(t).filter(|t| t.is_finite()), exact);
}

/// All at once through the stage, against every ray with every triangle by pinhole's function, to the last bit.
fn check_among(bench: &mut Bench, shots: &[(AimedRay, Corners)], exact: &[Option<f64>], score: &mut Score) {
    let table = triangle_table(shots.iter().map(|&(_, corners)| corners));
    let rays: Vec<AimedRay> = shots.iter().map(|&(ray, _)| ray).collect();
    bench.insert(table.clone());
    bench.aim(&rays);
    bench.run();
    let hits = bench.column::<Hits>();
    for (row, &ray) in rays.iter().enumerate() {
        let nearest = table.row.iter().map(|triangle| by_function(ray, triangle)).fold(f64::INFINITY, f64::min);
        score.check(hits.t[row].to_bits() == nearest.to_bits());
        if hits.shape[row] == row as u32 {
            score.check_t(Some(hits.t[row]), exact[row]);
        }
    }
}

/// The methods in f32, checked on the triangle that f32 can hold.
fn check_naive(ray: AimedRay, corners: Corners, exact_f64: Option<f64>, scores: &mut [Score]) {
    let rounded = corners.map(|corner| corner.as_vec3());
    let held = rounded.map(|corner| corner.as_dvec3());
    let truth = if held == corners { exact_f64 } else { exact(ray, held) };
    scores[0].check_t(hit_f32(ray.origin, ray.direction, rounded).map(f64::from), truth);
    scores[1].check_t(hit_woop_f32(ray.origin, ray.direction, rounded).map(f64::from), truth);
}
