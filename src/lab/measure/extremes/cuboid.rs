//! Rays against cuboids: faces, edges and corners, along axes and in the planes of faces, from afar and inside; and shadow
//! rays off them.

use super::bench::Bench;
use super::shadow_stages::{ShadowStages, leaving};
use super::sphere::T_BOUND;
use super::{Group, Method, Score, Tally, Trial};
use crate::measure::cuboid_aim::{Eye, Spot, cuboid_shot};
use crate::measure::oracle_cuboid::{self, side_of_cuboid};
use crate::measure::ray_aim::{AimedRay, Draws};
use crate::naive::cuboid::{face_by_epsilon, hit_f32, hit_widened_f32};
use crate::naive::shadow::{start_at_hit, start_off_surface};
use glam::Vec3;
use pinhole::extract::CuboidTable;
use pinhole::intersect::{Hits, cuboid_stage, start_stage};
use pinhole::shapes::{Slabs, cuboid_face, cuboid_t, offset_origin};
use std::ops::Range;

/// Cuboids and rays that the stage gets at once.
const AMONG: usize = 32;

/// Rows of a case of hits, and of a case of starts.
const HITS: [Method; 6] = [
    Method::pinhole("pinhole, one cuboid and one ray", "u of t", T_BOUND),
    Method::pinhole("pinhole, 32 cuboids and 32 rays", "u of t", T_BOUND),
    Method::pinhole("pinhole, the face that is hit", "", 0.0),
    Method::naive("naive, slabs by min and max, f32", "u of t", T_BOUND),
    Method::naive("naive, far side widened, f32", "u of t", T_BOUND),
    Method::naive("naive, the face within 1e-4", "", 0.0),
];
const STARTS: [Method; 4] = [
    Method::pinhole("pinhole, bound of the hit", "", 0.0),
    Method::pinhole("pinhole, past it, outside one 4e-5 smaller", "", 0.0),
    Method::naive("naive, at the hit", "", 0.0),
    Method::naive("naive, hit + 1e-4 n", "", 0.0),
];

/// What a case draws.
#[derive(Clone, Copy)]
struct View {
    seed: u64,
    spot: Spot,
    eye: Eye,
    sizes: f64,
    ratio: f64,
}

impl View {
    fn shot(self, index: u64) -> (AimedRay, Slabs) {
        cuboid_shot(self.seed, index, self.spot, self.eye, self.sizes, self.ratio)
    }
}

/// The cases of the group.
pub fn trials() -> Vec<Trial> {
    let hits = [
        ("faces from 1e3 sizes", Spot::Face, Eye::Far(1e3), 0.0, 1.0),
        ("edges from 1e3 sizes", Spot::Edge, Eye::Far(1e3), 0.0, 1.0),
        ("corners from 1e3 sizes", Spot::Corner, Eye::Far(1e3), 0.0, 1.0),
        ("edges from 1e5 sizes, 1e3 times as long", Spot::Edge, Eye::Far(1e5), 3.0, 3.0),
        ("corners from 1e7 sizes, 1e5 times as long", Spot::Corner, Eye::Far(1e7), 8.0, 5.0),
        ("edges, any size and place 1e-8 to 1e8", Spot::Edge, Eye::Anywhere, 8.0, 2.0),
        ("along an axis at edges, zeros of both signs", Spot::Edge, Eye::Axis, 3.0, 2.0),
        ("in the plane of a face, zeros of both signs", Spot::Corner, Eye::InFace, 3.0, 2.0),
        ("edges from inside, any size", Spot::Edge, Eye::Inside, 8.0, 3.0),
        ("faces from inside, any size", Spot::Face, Eye::Inside, 8.0, 3.0),
    ];
    let starts = [
        ("shadow rays off faces, any size and place", Spot::Face, Eye::Anywhere, 8.0, 2.0),
        ("shadow rays off faces, from 1e3 sizes", Spot::Face, Eye::Far(1e3), 8.0, 3.0),
        ("shadow rays off edges, any size and place", Spot::Edge, Eye::Anywhere, 8.0, 2.0),
        ("shadow rays off corners, from 10 sizes", Spot::Corner, Eye::Far(10.0), 8.0, 1.0),
        ("shadow rays from inside, at faces", Spot::Face, Eye::Inside, 8.0, 2.0),
        ("shadow rays from inside, at edges", Spot::Edge, Eye::Inside, 8.0, 2.0),
    ];
    let view = |(seed, (name, spot, eye, sizes, ratio)): (u64, (&'static str, Spot, Eye, f64, f64))| {
        (name, View { seed, spot, eye, sizes, ratio })
    };
    let of_hits = (301..).zip(hits).map(view);
    let of_hits = of_hits.map(|(name, view)| Trial::new(Group::Cuboid, name, &HITS, move |range| check(view, range)));
    let of_starts = (321..).zip(starts).map(view);
    let of_starts =
        of_starts.map(|(name, view)| Trial::new(Group::Cuboid, name, &STARTS, move |range| check_starts(view, range)));
    of_hits.chain(of_starts).collect()
}

/// The table of these cuboids; a cuboid's shape number is its place.
fn table(slabs: Vec<Slabs>) -> CuboidTable {
    slabs.into_iter().collect()
}

/// The exact distance, rounded to f64 once, and the axis of the face.
fn exact(ray: AimedRay, slabs: &Slabs) -> Option<(f64, usize)> {
    oracle_cuboid::cuboid_t(ray.origin, ray.direction, slabs)
}

fn by_function(ray: AimedRay, slabs: &Slabs) -> f64 {
    cuboid_t(ray.origin.as_dvec3(), ray.direction.as_dvec3(), slabs)
}

fn check(view: View, range: Range<u64>) -> Tally {
    let mut tally = Tally::new(HITS.len());
    let mut bench = Bench::new(&[start_stage(), cuboid_stage()]);
    let shots: Vec<(AimedRay, Slabs)> = range.map(|index| view.shot(index)).collect();
    for shots in shots.chunks(AMONG) {
        let exact: Vec<Option<(f64, usize)>> = shots.iter().map(|(ray, slabs)| exact(*ray, slabs)).collect();
        for ((ray, slabs), &exact) in shots.iter().zip(&exact) {
            tally.count(exact.is_some());
            let t = exact.map(|(t, _)| t);
            check_alone(&mut bench, *ray, slabs, t, &mut tally.scores[0]);
            if let Some((_, axis)) = exact {
                let face = cuboid_face(ray.origin.as_dvec3(), ray.direction.as_dvec3(), slabs);
                tally.scores[2].check(face == axis);
            }
            check_naive(*ray, slabs, &mut tally.scores[3..]);
        }
        check_among(&mut bench, shots, &exact, &mut tally.scores[1]);
    }
    tally
}

/// One ray and one cuboid through the stage: no neighbour can save a ray from being culled.
fn check_alone(bench: &mut Bench, ray: AimedRay, slabs: &Slabs, exact: Option<f64>, score: &mut Score) {
    bench.insert(table(vec![*slabs]));
    bench.aim(&[ray]);
    bench.run();
    let t = bench.column::<Hits>().t[0];
    score.check(t.to_bits() == by_function(ray, slabs).to_bits());
    score.check_t(Some(t).filter(|t| t.is_finite()), exact);
}

/// All at once through the stage, against every ray with every cuboid by pinhole's function, to the last bit.
fn check_among(bench: &mut Bench, shots: &[(AimedRay, Slabs)], exact: &[Option<(f64, usize)>], score: &mut Score) {
    bench.insert(table(shots.iter().map(|(_, slabs)| *slabs).collect()));
    let rays: Vec<AimedRay> = shots.iter().map(|(ray, _)| *ray).collect();
    bench.aim(&rays);
    bench.run();
    let hits = bench.column::<Hits>();
    for (row, &ray) in rays.iter().enumerate() {
        let nearest = shots.iter().map(|(_, slabs)| by_function(ray, slabs)).fold(f64::INFINITY, f64::min);
        score.check(hits.t[row].to_bits() == nearest.to_bits());
        if hits.shape[row] == row as u32 {
            score.check_t(Some(hits.t[row]), exact[row].map(|(t, _)| t));
        }
    }
}

/// The naive methods, checked on the cuboid that f32 can hold.
fn check_naive(ray: AimedRay, slabs: &Slabs, scores: &mut [Score]) {
    let (centre, half) = (slabs.centre.as_vec3(), slabs.half.map(|half| half as f32));
    let rounded = Slabs { centre: centre.as_dvec3(), half: half.map(f64::from), ..*slabs };
    let exact = exact(ray, &rounded);
    let to_cube = |v: Vec3| Vec3::from([0, 1, 2].map(|axis| slabs.normal[axis].as_vec3().dot(v) / half[axis]));
    let (origin, direction) = (to_cube(ray.origin - centre), to_cube(ray.direction));
    let t = exact.map(|(t, _)| t);
    let naive = hit_f32(origin, direction);
    scores[0].check_t(naive.map(f64::from), t);
    scores[1].check_t(hit_widened_f32(origin, direction).map(f64::from), t);
    if let (Some((_, axis)), Some(naive)) = (exact, naive) {
        scores[2].check(face_by_epsilon(origin + naive * direction) == Some(axis));
    }
}

/// A start is right when it lies strictly on the side of the ray; from outside its shadow ray never hits the cuboid again.
fn check_starts(view: View, range: Range<u64>) -> Tally {
    let (mut tally, mut stages) = (Tally::new(STARTS.len()), ShadowStages::of_cuboids());
    for index in range {
        let (ray, slabs) = view.shot(index);
        stages.cuboids(table(vec![slabs]));
        let side = side_of_cuboid(ray.origin.as_dvec3(), &slabs);
        let thinnest = slabs.half.iter().copied().fold(f64::INFINITY, f64::min);
        let mut draws = Draws::new(view.seed + 1000, index);
        let left = stages.surface(ray).filter(|(_, surface)| {
            // From inside, a cuboid thinner than a few bounds has no room to start in.
            side > 0 || (side < 0 && thinnest > 4.0 * f64::from(surface.bound))
        });
        let left = left.and_then(|(_, surface)| {
            let away =
                leaving(&mut draws, surface.normal, 6.0) * (slabs.bounding_radius * draws.power_of_ten(-3.0, 2.0));
            Some((surface, stages.shadow(surface, surface.position.as_dvec3() + away)?))
        });
        tally.count(left.is_some());
        let Some((surface, shadow)) = left else { continue };
        let again = AimedRay { origin: shadow.origin, direction: shadow.direction };
        let hits = by_function(again, &slabs).is_finite();
        let never_again = side < 0 || (!hits && shadow.blocked.is_none());
        tally.scores[0].check(side_of_cuboid(shadow.origin.as_dvec3(), &slabs) == side && never_again);
        let smaller = Slabs { half: slabs.half.map(|half| half * (1.0 - 4e-5)), ..slabs };
        let gap = 4e-5 * thinnest;
        if side > 0 && matches!(view.spot, Spot::Face) && gap > 4.0 * f64::from(surface.bound) {
            let beyond = offset_origin(surface.position, -surface.normal, surface.bound).as_dvec3();
            tally.scores[1].check(side_of_cuboid(beyond, &smaller) > 0);
        }
        if side > 0 {
            let starts = [start_at_hit(surface.position), start_off_surface(surface.position, surface.normal)];
            for (score, start) in tally.scores[2..].iter_mut().zip(starts) {
                let ray = AimedRay { origin: start.origin, direction: shadow.direction };
                score.check(exact(ray, &slabs).is_none_or(|(t, _)| t <= f64::from(start.t_min)));
            }
        }
    }
    tally
}
