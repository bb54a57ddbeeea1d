//! Triangles and rays that are hardly any: directions of all lengths, parts of 0 and near it, no direction at all; two
//! triangles in one place.

use super::bench::Bench;
use super::triangle::{BESIDE, T_BOUND, by_function, exact};
use super::triangle_aim::{Corners, From, SampleLights, View, shot, triangle_table};
use super::{Group, Method, Tally, Trial};
use crate::measure::ray_aim::{AimedRay, Draws};
use crate::naive::triangle::hit_f32;
use glam::{DVec3, Vec3};
use pinhole::intersect::{Hits, NO_SHAPE, start_stage, triangle_stage};
use pinhole::shapes::TriangleRow;

/// Rays and triangles of one block.
const BLOCK: usize = 16;

/// The cases.
pub fn trials() -> Vec<Trial> {
    let trials = [axes(), lengths_of_directions(), no_rays(), ends(), duplicates()];
    trials.map(|trial| trial.at_most(BESIDE)).into()
}

fn one_by_one(
    name: &str,
    methods: &[Method],
    check: impl Fn(&mut Bench, u64, &mut Tally) + Send + Sync + 'static,
) -> Trial {
    let rows = methods.len();
    Trial::new(Group::Triangle, name, methods, move |range| {
        let mut tally = Tally::new(rows);
        let mut bench = Bench::new(&[start_stage(), triangle_stage()]);
        range.for_each(|index| check(&mut bench, index, &mut tally));
        tally
    })
}

/// A ray and a triangle whose edges it is aimed at.
fn at_edge(seed: u64, index: u64) -> (AimedRay, Corners) {
    shot(View { seed, thinnest: 1.0, aim: SampleLights::Edge, from: From::Eye(3.0) }, index)
}

/// Corners on a grid of eighths and rays along the axes or nearly: by parts of 0 with either sign, and denormal ones.
fn axes() -> Trial {
    const ROWS: [Method; 2] = [
        Method::pinhole("pinhole, hit or miss, t", "u of t", T_BOUND),
        Method::naive("naive Moller-Trumbore, 1e-6, f32", "u of t", T_BOUND),
    ];
    one_by_one("parts of 0, -0 and denormal, corners on a grid", &ROWS, |bench, index, tally| {
        let mut draws = Draws::new(261, index);
        let scale = libm::ldexp(1.0, draws.between(-20.0, 21.0).floor() as i32);
        let mut on_grid = || DVec3::from([(); 3].map(|()| draws.between(-4.0, 5.0).floor() / 8.0 * scale));
        let (corners, origin) = ([on_grid(), on_grid(), on_grid()], on_grid().as_vec3());
        let smallest = f32::from_bits(1 + (draws.unit() * 100.0) as u32);
        let mut small = || {
            let part = [0.0, -0.0, smallest, -smallest][(draws.unit() * 4.0) as usize];
            if draws.unit() < 0.2 { 1.0_f32.copysign(part) } else { part }
        };
        let mut direction = Vec3::new(small(), small(), small());
        direction[(draws.unit() * 3.0) as usize] = if draws.unit() < 0.5 { -1.0 } else { 1.0 };
        let ray = AimedRay { origin, direction };
        let truth = exact(ray, corners);
        tally.count(truth.is_some());
        bench.insert(triangle_table([corners]));
        bench.aim(&[ray]);
        bench.run();
        let t = bench.column::<Hits>().t[0];
        tally.scores[0].check_t(Some(t).filter(|t| t.is_finite()), truth);
        let naive = hit_f32(origin, direction, corners.map(|corner| corner.as_vec3()));
        tally.scores[1].check_t(naive.map(f64::from), truth);
    })
}

/// A direction 2ᵏ times as long gives t / 2ᵏ, to the last bit.
fn lengths_of_directions() -> Trial {
    const ROWS: [Method; 2] = [
        Method::pinhole("pinhole, every bit of t", "", 0.0),
        Method::naive("naive Moller-Trumbore, 1e-6, f32", "", 0.0),
    ];
    one_by_one("directions 2^-60 to 2^60 long", &ROWS, |_, index, tally| {
        let (ray, corners) = at_edge(262, index);
        let scale = libm::ldexp(1.0, Draws::new(263, index).between(-60.0, 61.0).floor() as i32);
        let longer = AimedRay { direction: ray.direction * scale as f32, ..ray };
        let triangle = TriangleRow::new(corners);
        let t = by_function(ray, &triangle);
        tally.count(t.is_finite());
        tally.scores[0].check(t.to_bits() == (by_function(longer, &triangle) * scale).to_bits());
        let rounded = corners.map(|corner| corner.as_vec3());
        let naive = |ray: AimedRay| hit_f32(ray.origin, ray.direction, rounded).map(f64::from);
        let [t, of_longer] = [naive(ray).unwrap_or(-1.0), naive(longer).unwrap_or(-1.0 / scale)];
        tally.scores[1].check(t.to_bits() == (of_longer * scale).to_bits());
    })
}

/// One ray of a block has a part that is NaN or not finite, or no direction: it hits nothing, and its neighbours
/// hit what they hit alone.
fn no_rays() -> Trial {
    const ROWS: [Method; 1] = [Method::pinhole("pinhole, hits nothing, spoils nothing", "", 0.0)];
    one_by_one("a ray with no direction, NaN or infinite", &ROWS, |bench, index, tally| {
        let shot = |component: usize| at_edge(264, index * BLOCK as u64 + component as u64);
        let (mut rays, corners): (Vec<AimedRay>, Vec<Corners>) = (0..BLOCK).map(shot).unzip();
        let (bad, part) = (index as usize % BLOCK, index as usize / BLOCK % 3);
        match index / 3 % 4 {
            0 => rays[bad].direction = Vec3::ZERO,
            1 => rays[bad].direction[part] = f32::NAN,
            2 => rays[bad].direction[part] = f32::INFINITY,
            _ => rays[bad].origin[part] = f32::NAN,
        }
        let table = triangle_table(corners);
        bench.insert(table.clone());
        bench.aim(&rays);
        bench.run();
        let hits = bench.column::<Hits>();
        tally.count(true);
        for (component, &ray) in rays.iter().enumerate() {
            let nearest = table.row.iter().map(|triangle| by_function(ray, triangle)).fold(f64::INFINITY, f64::min);
            let nothing = hits.t[component] == f64::INFINITY && hits.shape[component] == NO_SHAPE;
            tally.scores[0].check(if component == bad {
                nothing
            } else {
                hits.t[component].to_bits() == nearest.to_bits()
            });
        }
    })
}

/// A ray that looks without end, and one that looks as far as 1e30: both hit the same at the same distance.
fn ends() -> Trial {
    const ROWS: [Method; 1] = [Method::pinhole("pinhole, the same hits", "", 0.0)];
    Trial::new(Group::Triangle, "rays that end at 1e30, and without end", &ROWS, |range| {
        let (mut tally, mut bench) = (Tally::new(ROWS.len()), Bench::new(&[triangle_stage()]));
        for index in range {
            let (ray, corners) = at_edge(265, index);
            bench.insert(triangle_table([corners]));
            bench.aim(&[ray]);
            let mut found = [1e30, f64::INFINITY].map(|end| {
                let mut hits = Hits::default();
                let (t, shape) = hits.slices_mut(1);
                (t[0], shape[0]) = (end, NO_SHAPE);
                bench.put(hits);
                bench.run();
                let hits = bench.column::<Hits>();
                (hits.t[0], hits.shape[0])
            });
            let hit = found[0].1 != NO_SHAPE;
            tally.count(hit);
            if !hit {
                found[0].0 = f64::INFINITY;
            }
            tally.scores[0].check(found[0] == found[1] && found[1].0 == by_function(ray, &TriangleRow::new(corners)));
        }
        tally
    })
}

/// The same three corners several times, in any order: the lowest number is hit, at the same distance to the last bit.
fn duplicates() -> Trial {
    const ROWS: [Method; 1] = [Method::pinhole("pinhole, the lowest number, the same t", "", 0.0)];
    const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    one_by_one("six triangles of the same three corners", &ROWS, |bench, index, tally| {
        let view = View { seed: 266, thinnest: 3.0, aim: SampleLights::Inside, from: From::Anywhere(6.0) };
        let (ray, corners) = shot(view, index);
        let mut table = triangle_table(ORDERS.map(|order| order.map(|corner| corners[corner])));
        let turned = Draws::new(267, index).between(0.0, 6.0) as usize;
        table.shape.rotate_left(turned);
        bench.insert(table);
        bench.aim(&[ray]);
        bench.run();
        let hits = bench.column::<Hits>();
        let t = by_function(ray, &TriangleRow::new(corners));
        tally.count(t.is_finite());
        let lowest = if t.is_finite() { 0 } else { NO_SHAPE };
        tally.scores[0].check(hits.t[0].to_bits() == t.to_bits() && hits.shape[0] == lowest);
    })
}
