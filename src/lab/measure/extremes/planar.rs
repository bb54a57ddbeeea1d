//! Rays against disks and rectangles: edges, corners, grazing rays, from near and from afar; and shadow rays off them.

use super::bench::Bench;
use super::shadow_stages::{ShadowStages, leaving};
use super::sphere::T_BOUND;
use super::{Group, Method, Score, Tally, Trial};
use crate::measure::oracle_disk::{self, side_of_planar};
use crate::measure::oracle_rectangle;
use crate::measure::planar_aim::{At, View, edge_on, planar_shot};
use crate::measure::ray_aim::{AimedRay, Draws};
use crate::naive::planar::{hit_disk_f32, hit_rectangle_f32};
use crate::naive::shadow::{start_at_hit, start_off_surface};
use pinhole::extract::{DiskTable, RectangleTable};
use pinhole::intersect::{Hits, disk_stage, rectangle_stage, start_stage};
use pinhole::shapes::{PlacedDisk, PlacedRectangle, Planar, disk_t, offset_origin, rectangle_t};
use std::cmp::Ordering;
use std::ops::Range;

/// Shapes and rays that the stage gets at once.
const AMONG: usize = 32;

/// Rows of a case of hits, and of a case of starts.
const HITS: [Method; 3] = [
    Method::pinhole("pinhole, one shape and one ray", "u of t", T_BOUND),
    Method::pinhole("pinhole, 32 shapes and 32 rays", "u of t", T_BOUND),
    Method::naive("naive, f32 hit point, then inside", "u of t", T_BOUND),
];
const STARTS: [Method; 4] = [
    Method::pinhole("pinhole, bound of the hit", "", 0.0),
    Method::pinhole("pinhole, past it, short of one 4e-5 behind", "", 0.0),
    Method::naive("naive, at the hit", "", 0.0),
    Method::naive("naive, hit + 1e-4 n", "", 0.0),
];

/// Disks or rectangles.
#[derive(Clone, Copy)]
pub enum Kind {
    /// Cut by the sum of squares.
    Disk,
    /// Cut by each coordinate.
    Rectangle,
}

impl Kind {
    fn group(self) -> Group {
        match self {
            Self::Disk => Group::Disk,
            Self::Rectangle => Group::Rectangle,
        }
    }

    /// Where its cut is hard to check.
    fn edge(self) -> At {
        match self {
            Self::Disk => At::Rim,
            Self::Rectangle => At::Edge,
        }
    }

    fn bench(self) -> Bench {
        match self {
            Self::Disk => Bench::new(&[start_stage(), disk_stage()]),
            Self::Rectangle => Bench::new(&[start_stage(), rectangle_stage()]),
        }
    }

    fn insert(self, bench: &mut Bench, planar: Vec<Planar>) {
        let planar = planar.into_iter();
        match self {
            Self::Disk => bench.insert(planar.map(|planar| PlacedDisk { planar }).collect::<DiskTable>()),
            Self::Rectangle => {
                bench.insert(planar.map(|planar| PlacedRectangle { planar }).collect::<RectangleTable>())
            }
        }
    }

    /// The exact distance, rounded to f64 once.
    fn exact(self, ray: AimedRay, planar: &Planar) -> Option<f64> {
        match self {
            Self::Disk => oracle_disk::disk_t(ray.origin, ray.direction, planar),
            Self::Rectangle => oracle_rectangle::rectangle_t(ray.origin, ray.direction, planar),
        }
    }

    /// The distance by pinhole's function of one ray and one shape.
    fn by_function(self, ray: AimedRay, planar: &Planar) -> f64 {
        let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        match self {
            Self::Disk => disk_t(origin, direction, planar),
            Self::Rectangle => rectangle_t(origin, direction, planar),
        }
    }

    fn naive(self, ray: AimedRay, planar: &Planar) -> Option<f32> {
        let (centre, normal, along) =
            (planar.centre.as_vec3(), planar.normal.as_vec3(), planar.along.map(|along| along.as_vec3()));
        match self {
            Self::Disk => hit_disk_f32(ray.origin, ray.direction, centre, normal, along),
            Self::Rectangle => hit_rectangle_f32(ray.origin, ray.direction, centre, normal, along),
        }
    }
}

/// The cases of one of the two groups.
pub fn trials(kind: Kind) -> Vec<Trial> {
    let (edge, seed) = (kind.edge(), 200 + 50 * kind as u64);
    let hits = [
        ("far edges, 1e3 sizes away", edge, 0.0, 1.0, [3.0, 3.0], true),
        ("far edges, 1e5 sizes away", edge, 0.0, 1.0, [5.0, 5.0], true),
        ("far edges, 1e7 sizes away", edge, 0.0, 1.0, [7.0, 7.0], true),
        ("edges from 1e3 sizes, slope from 1e-8", edge, 0.0, 8.0, [3.0, 3.0], true),
        ("corners of the square from 1e5 sizes", At::Corner, 0.0, 1.0, [5.0, 5.0], true),
        ("anywhere, any size and place 1e-8 to 1e8", At::Inside, 8.0, 1.0, [-2.0, 4.0], false),
        ("edges, any size and place 1e-8 to 1e8", edge, 8.0, 4.0, [-2.0, 4.0], false),
        ("edges, any size, slope from 1e-12, seen", edge, 8.0, 12.0, [-2.0, 7.0], true),
    ];
    let view =
        |(seed, (name, at, sizes, flattest, away, from_eye)): (u64, (&'static str, At, f64, f64, [f64; 2], bool))| {
            (name, View { seed, at, sizes, flattest, away, from_eye })
        };
    let of_hits = (seed..).zip(hits).map(view).map(|(name, view)| {
        Trial::new(kind.group(), name, &HITS, move |range| check(kind, range, |index| planar_shot(view, index)))
    });
    let along =
        Trial::new(kind.group(), "rays along it and in its plane, zeros of both signs", &HITS[..2], move |range| {
            check(kind, range, edge_on)
        });
    let starts = [
        ("shadow rays, any size and place 1e-8 to 1e8", At::Inside, 8.0, 1.0, [-2.0, 4.0], false),
        ("shadow rays, any size, slope from 1e-8, seen", At::Inside, 8.0, 8.0, [-2.0, 7.0], true),
        ("shadow rays at edges, any size and place", edge, 8.0, 4.0, [-2.0, 4.0], false),
    ];
    let of_starts = (seed + 20..)
        .zip(starts)
        .map(view)
        .map(|(name, view)| Trial::new(kind.group(), name, &STARTS, move |range| check_starts(kind, view, range)));
    of_hits.chain([along]).chain(of_starts).collect()
}

fn check(kind: Kind, range: Range<u64>, aim: impl Fn(u64) -> (AimedRay, Planar)) -> Tally {
    let mut tally = Tally::new(HITS.len());
    let mut bench = kind.bench();
    let shots: Vec<(AimedRay, Planar)> = range.map(aim).collect();
    for shots in shots.chunks(AMONG) {
        let exact: Vec<Option<f64>> = shots.iter().map(|(ray, planar)| kind.exact(*ray, planar)).collect();
        for ((ray, planar), &exact) in shots.iter().zip(&exact) {
            tally.count(exact.is_some());
            check_alone(kind, &mut bench, *ray, planar, exact, &mut tally.scores[0]);
            let rounded = rounded_to_f32(planar);
            let naive = kind.naive(*ray, &rounded).map(f64::from);
            tally.scores[2].check_t(naive, kind.exact(*ray, &rounded));
        }
        check_among(kind, &mut bench, shots, &exact, &mut tally.scores[1]);
    }
    tally
}

/// The shape that an f32 method sees.
fn rounded_to_f32(planar: &Planar) -> Planar {
    let along = planar.along.map(|along| along.as_vec3().as_dvec3());
    Planar { centre: planar.centre.as_vec3().as_dvec3(), along, ..*planar }
}

/// One ray and one shape through the stage.
fn check_alone(kind: Kind, bench: &mut Bench, ray: AimedRay, planar: &Planar, exact: Option<f64>, score: &mut Score) {
    kind.insert(bench, vec![*planar]);
    bench.aim(&[ray]);
    bench.run();
    let t = bench.column::<Hits>().t[0];
    score.check(t.to_bits() == kind.by_function(ray, planar).to_bits());
    score.check_t(Some(t).filter(|t| t.is_finite()), exact);
}

/// All at once through the stage, against every ray with every shape by pinhole's function, to the last bit.
fn check_among(kind: Kind, bench: &mut Bench, shots: &[(AimedRay, Planar)], exact: &[Option<f64>], score: &mut Score) {
    kind.insert(bench, shots.iter().map(|(_, planar)| *planar).collect());
    let rays: Vec<AimedRay> = shots.iter().map(|(ray, _)| *ray).collect();
    bench.aim(&rays);
    bench.run();
    let hits = bench.column::<Hits>();
    for (row, &ray) in rays.iter().enumerate() {
        let nearest = shots.iter().map(|(_, planar)| kind.by_function(ray, planar)).fold(f64::INFINITY, f64::min);
        score.check(hits.t[row].to_bits() == nearest.to_bits());
        if hits.shape[row] == row as u32 {
            score.check_t(Some(hits.t[row]), exact[row]);
        }
    }
}

/// A start is right when it lies strictly on the side of the ray and its shadow ray never hits the shape again.
fn check_starts(kind: Kind, view: View, range: Range<u64>) -> Tally {
    let mut tally = Tally::new(STARTS.len());
    let mut stages = match kind {
        Kind::Disk => ShadowStages::of_disks(),
        Kind::Rectangle => ShadowStages::of_rectangles(),
    };
    for index in range {
        let (ray, planar) = planar_shot(view, index);
        match kind {
            Kind::Disk => stages.disks([PlacedDisk { planar }].into_iter().collect()),
            Kind::Rectangle => stages.rectangles([PlacedRectangle { planar }].into_iter().collect()),
        }
        let side = side_of_planar(ray.origin.as_dvec3(), &planar);
        let mut draws = Draws::new(view.seed + 1000, index);
        let size = planar.half_edges()[0].length();
        let left = stages.surface(ray).and_then(|(_, surface)| {
            let away = leaving(&mut draws, surface.normal, 6.0) * (size * draws.power_of_ten(-2.0, 3.0));
            Some((surface, stages.shadow(surface, surface.position.as_dvec3() + away)?))
        });
        tally.count(left.is_some());
        let Some((surface, shadow)) = left else { continue };
        let again = kind.by_function(AimedRay { origin: shadow.origin, direction: shadow.direction }, &planar);
        let on_its_side = side_of_planar(shadow.origin.as_dvec3(), &planar) == side;
        tally.scores[0].check(on_its_side && shadow.blocked.is_none() && !again.is_finite());
        // Where numbers are fine enough for a second shape that near behind it.
        let gap = 4e-5 * size;
        let beyond = offset_origin(surface.position, -surface.normal, surface.bound).as_dvec3();
        let outwards = surface.normal.as_dvec3();
        let behind = Planar { centre: planar.centre - outwards * gap, ..planar };
        if gap > 4.0 * f64::from(surface.bound) {
            let between = side_of_planar(beyond, &planar) != side && side_of_planar(beyond, &behind) == side;
            tally.scores[1].check(between && side != Ordering::Equal);
        }
        let starts = [start_at_hit(surface.position), start_off_surface(surface.position, surface.normal)];
        for (score, start) in tally.scores[2..].iter_mut().zip(starts) {
            let ray = AimedRay { origin: start.origin, direction: shadow.direction };
            score.check(kind.exact(ray, &planar).is_none_or(|t| t <= f64::from(start.t_min)));
        }
    }
    tally
}
