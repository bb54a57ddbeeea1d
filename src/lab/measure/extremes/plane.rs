//! Rays against planes: any offset, seen from anywhere, the flatter the harder.

use super::bench::{Bench, plane_table};
use super::{Group, Method, Score, Tally, Trial};
use crate::measure::oracle_plane::{self, Plane};
use crate::measure::ray_aim::{AimedRay, plane_of_any_offset};
use crate::naive::plane::hit_f32;
use glam::Vec3;
use pinhole::intersect::{Hits, plane_stage, start_stage};
use pinhole::shapes::plane_t;
use std::ops::Range;

/// Planes and rays that the stage gets at once.
const AMONG: usize = 64;

/// The rows of a case that asks for a distance good to `bound`.
const fn methods(bound: f64) -> [Method; 3] {
    [
        Method::pinhole("pinhole, a plane and a ray at a time", "u of t", bound),
        Method::pinhole("pinhole, 64 planes and 64 rays", "u of t", bound),
        Method::naive("naive, |n.d| > 1e-6, t > 1e-3, f32", "u of t", bound),
    ]
}

/// Where the rays of a case start and how flat they come in.
#[derive(Clone, Copy)]
struct View {
    seed: u64,
    /// The slope is 10 to minus this, or more.
    flattest: f64,
    /// Whether all start at the eye: then t loses digits only where the view is flat.
    from_eye: bool,
}

/// The cases of the group.
///
/// A distance from somewhere else than the eye is a difference of two numbers of any size, k − n·O, and as good as they
/// allow: there, only hit or miss is asked.
pub fn trials() -> Vec<Trial> {
    const WITHIN_U: f64 = 1.0;
    let views = [
        ("any offset, from the eye, slope from 1e-4", 4.0, true, WITHIN_U),
        ("any offset, from the eye, slope from 1e-12", 12.0, true, f64::INFINITY),
        ("any offset and place 1e-8 to 1e8, slope from 1", 0.0, false, f64::INFINITY),
        ("any offset and place 1e-8 to 1e8, slope from 1e-4", 4.0, false, f64::INFINITY),
        ("any offset and place 1e-8 to 1e8, slope from 1e-8", 8.0, false, f64::INFINITY),
        ("any offset and place 1e-8 to 1e8, slope from 1e-12", 12.0, false, f64::INFINITY),
    ];
    let trial = |(seed, (name, flattest, from_eye, bound)): (u64, (&str, f64, bool, f64))| {
        let view = View { seed, flattest, from_eye };
        Trial::new(Group::Plane, name, &methods(bound), move |range| check(view, range))
    };
    (51..).zip(views).map(trial).collect()
}

/// A ray and a plane as its table holds it: the parts of the normal are exact in f32.
pub(super) fn aim(seed: u64, index: u64, flattest: f64) -> (AimedRay, Plane) {
    let (ray, plane) = plane_of_any_offset(seed, index, flattest);
    (ray, Plane { normal: plane.normal.as_vec3().as_dvec3(), ..plane })
}

/// The same; from the eye, the plane is turned to be before it.
fn aim_at(view: View, index: u64) -> (AimedRay, Plane) {
    let (ray, plane) = aim(view.seed, index, view.flattest);
    if !view.from_eye {
        return (ray, plane);
    }
    let seen = AimedRay { origin: Vec3::ZERO, ..ray };
    let (above, below) = (plane, Plane { offset: -plane.offset, ..plane });
    (seen, if plane.normal.dot(ray.direction.as_dvec3()) > 0.0 { above } else { below })
}

fn check(view: View, range: Range<u64>) -> Tally {
    let mut tally = Tally::new(methods(0.0).len());
    let mut bench = Bench::new(&[start_stage(), plane_stage()]);
    let shots: Vec<(AimedRay, Plane)> = range.map(|index| aim_at(view, index)).collect();
    for shots in shots.chunks(AMONG) {
        for &(ray, plane) in shots {
            let exact = exact(ray, plane);
            tally.count(exact.is_some());
            check_alone(&mut bench, ray, plane, exact, &mut tally.scores[0]);
            let rounded = plane.rounded_to_f32();
            let exact = if rounded == plane { exact } else { self::exact(ray, rounded) };
            let naive = hit_f32(ray.origin, ray.direction, rounded.normal.as_vec3(), rounded.offset as f32);
            tally.scores[2].check_t(naive.map(f64::from), exact);
        }
        check_among(&mut bench, shots, &mut tally.scores[1]);
    }
    tally
}

/// The exact distance, rounded to f64 once.
fn exact(ray: AimedRay, plane: Plane) -> Option<f64> {
    oracle_plane::plane_t(ray.origin, ray.direction, plane)
}

/// The distance by pinhole's function of one ray and one plane.
pub(super) fn by_function(ray: AimedRay, plane: Plane) -> f64 {
    plane_t(ray.origin.as_dvec3(), ray.direction.as_dvec3(), plane.normal, plane.offset)
}

fn check_alone(bench: &mut Bench, ray: AimedRay, plane: Plane, exact: Option<f64>, score: &mut Score) {
    bench.insert(plane_table(&[plane]));
    bench.aim(&[ray]);
    bench.run();
    let t = bench.column::<Hits>().t[0];
    score.check(t.to_bits() == by_function(ray, plane).to_bits());
    score.check_t(Some(t).filter(|t| t.is_finite()), exact);
}

/// All at once through the stage, against every ray with every plane by pinhole's function, to the last bit.
fn check_among(bench: &mut Bench, shots: &[(AimedRay, Plane)], score: &mut Score) {
    let (rays, planes): (Vec<_>, Vec<_>) = shots.iter().copied().unzip();
    bench.insert(plane_table(&planes));
    bench.aim(&rays);
    bench.run();
    let hits = bench.column::<Hits>();
    for (row, &ray) in rays.iter().enumerate() {
        let nearest = planes.iter().map(|&plane| by_function(ray, plane)).fold(f64::INFINITY, f64::min);
        score.check(hits.t[row].to_bits() == nearest.to_bits());
        if hits.shape[row] == row as u32 {
            score.check_t(Some(hits.t[row]), exact(ray, planes[row]));
        }
    }
}
