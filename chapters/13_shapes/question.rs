//! Chapter 13: where a ray first hits a box, compared with exact arithmetic.

use super::mine::mine;
use glam::{DVec3, Vec3};
use pinhole::shapes::Slabs;
use pinhole_lab::exercise::apart::{option, relative};
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::oracle_cuboid::cuboid_hit;
use pinhole_lab::measure::ray_aim::Draws;

/// Origin, direction, least and most; all with few digits, so that quotients that are equal come out equal.
pub(super) type Input = ([f64; 3], [f64; 3], [f64; 3], [f64; 3]);
pub(super) type Answer = Option<f64>;

/// What the reader writes.
pub type Yours = fn([f64; 3], [f64; 3], [f64; 3], [f64; 3]) -> Answer;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::nearest_box_t)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("nearest_box_t", question, move |&(o, d, least, most)| yours(o, d, least, most), mine)
}

fn question() -> Question<Input, Answer> {
    Question {
        pinhole_has: ("src/pinhole/shapes/cuboid.rs", "fn slab"),
        probes: asked(),
        tell: |(origin, direction, least, most)| {
            let [origin, direction, least, most] = [origin, direction, least, most].map(Shown::shown);
            format!("origin {origin}, direction {direction}, least {least}, most {most}")
        },
        right: |&(o, d, least, most)| cuboid_hit(single(o), single(d), &slabs(least, most)).map(|(t, _)| t.to_f64()),
        apart: |yours, right| option(yours, right, |yours, right| relative(&[*yours], &[*right])),
        allowed: 1e-12,
        measured: "of t",
        mistakes: vec![
            Mistake::new("what lies behind the origin is hit too: only t above 0 counts", |input| {
                passed(input, Along::Given).map(|[enters, _]| enters)
            }),
            Mistake::new(
                "from inside, nothing is hit: the ray entered behind the origin, but it leaves ahead",
                |input| passed(input, Along::Given).map(|[enters, _]| enters).filter(|&t| t > 0.0),
            ),
            Mistake::new("the far side is taken where the near one is ahead", |input| {
                passed(input, Along::Given).map(|[_, leaves]| leaves).filter(|&t| t > 0.0)
            }),
            Mistake::new("a ray in the plane of a face divides 0 by 0, and what is not a number loses it", |input| {
                passed(input, Along::Divided)?.into_iter().find(|&t| t > 0.0)
            }),
            Mistake::new(
                "a ray along a face is taken for one that misses: between the faces, all t will do",
                |input| passed(input, Along::Missed)?.into_iter().find(|&t| t > 0.0),
            ),
            Mistake::new(
                "the ray is not yet inside where it enters the first slab, only where it enters the last slab",
                |input| {
                    let &(o, d, least, most) = input;
                    passed(input, Along::Given)?;
                    let near =
                        |axis: usize| f64::min((least[axis] - o[axis]) / d[axis], (most[axis] - o[axis]) / d[axis]);
                    (0..3).filter(|&axis| d[axis] != 0.0).map(near).filter(|&t| t > 0.0).reduce(f64::min)
                },
            ),
        ],
        hints: &[
            "a box is what three slabs have in common: least ≤ x ≤ most for each coordinate by itself",
            "the ray crosses the two faces of a slab at (least − o) / d and (most − o) / d; it enters at the smaller of \
             the two and leaves at the larger",
            "it is inside the box from the largest of the three entries to the smallest of the three exits, if the one \
             is not beyond the other",
            "where d is 0 ask whether least ≤ o ≤ most: if not, there is no hit, and if so, this slab asks nothing; then \
             take the entry if it is above 0, else the exit if that is",
        ],
    }
}

/// What is done with a direction that is 0 along an axis.
#[derive(Clone, Copy, PartialEq)]
enum Along {
    Given,
    Divided,
    Missed,
}

/// From where to where a ray is inside a box, whatever lies behind it.
fn passed(&(o, d, least, most): &Input, along: Along) -> Option<[f64; 2]> {
    let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        if d[axis] == 0.0 && along != Along::Divided {
            if along == Along::Missed || o[axis] < least[axis] || o[axis] > most[axis] {
                return None;
            }
            continue;
        }
        let [low, high] = [(least[axis] - o[axis]) / d[axis], (most[axis] - o[axis]) / d[axis]];
        if low.is_nan() || high.is_nan() {
            return None;
        }
        (enters, leaves) = (enters.max(low.min(high)), leaves.min(low.max(high)));
    }
    (enters <= leaves).then_some([enters, leaves])
}

fn asked() -> Vec<Probe<Input>> {
    let (least, most) = ([-1.0, -2.0, -4.0], [1.0, 2.0, -2.0]);
    let at = |origin, direction| (origin, direction, least, most);
    let mut asked: Vec<_> = probes("straight at a face", [at([0.25, 0.5, 0.0], [0.0, 0.0, -1.0])]).collect();
    asked.extend(probes("past the box", [at([3.0, 0.0, 0.0], [0.0, 0.0, -1.0])]));
    asked.extend(probes(
        "obliquely",
        [at([3.0, 1.0, 0.5], [-1.0, -0.25, -1.0]), at([-3.0, 0.5, -1.0], [1.0, 0.125, -0.75])],
    ));
    asked.extend(probes("a box behind the origin", [at([0.25, 0.5, 0.0], [0.0, 0.125, 1.0])]));
    asked.extend(probes(
        "from inside",
        [at([0.25, 0.5, -3.0], [0.5, 0.25, -0.125]), at([0.0, 0.0, -3.0], [0.0, 1.0, 0.0])],
    ));
    asked.extend(probes("a direction of length 2", [at([0.25, 0.5, 0.0], [0.0, 0.0, -2.0])]));
    asked.extend(probes(
        "a zero below zero",
        [at([0.25, 0.5, 0.0], [-0.0, -0.0, -1.0]), at([-3.0, 0.5, -3.0], [1.0, -0.0, 0.0])],
    ));
    asked.extend(probes(
        "along a face",
        [at([1.0, 0.5, 0.0], [0.0, 0.0, -1.0]), at([-3.0, 2.0, -3.0], [1.0, -0.0, 0.0])],
    ));
    asked.extend(probes("beside a face", [at([1.125, 0.5, 0.0], [0.0, 0.0, -1.0])]));
    asked.extend(probes("along an edge", [at([1.0, 2.0, 0.0], [0.0, 0.0, -1.0])]));
    asked
        .extend(probes("at an edge", [at([3.0, 0.0, 0.0], [-1.0, 0.0, -1.0]), at([0.0, 4.0, 0.0], [0.0, -1.0, -1.0])]));
    asked.extend(probes("from a face, outward", [at([1.0, 0.0, -3.0], [1.0, 0.0, 0.0])]));
    asked.extend(probes("from a face, inward", [at([1.0, 0.0, -3.0], [-1.0, 0.0, 0.0])]));
    asked.extend(probes("anything", (0..200).map(drawn)));
    asked
}

/// A box and a ray of numbers with few digits, mostly at it; directions are powers of two or 0, so that no quotient rounds.
fn drawn(index: u64) -> Input {
    let mut draws = Draws::new(313, index);
    let mut step = |range: f64| (draws.unit() * range * 2.0 - range).round() / 8.0;
    let least = [step(32.0), step(32.0), step(32.0)];
    let size = [step(16.0), step(16.0), step(16.0)].map(|part| part.abs() + 0.125);
    let origin = [step(64.0), step(64.0), step(64.0)];
    let direction = [step(20.0), step(20.0), step(20.0)].map(|part: f64| match part.abs() {
        small if small < 0.5 => 0.0 * part,
        middle if middle < 1.5 => part.signum(),
        _ => 2.0 * part.signum(),
    });
    let direction = if direction == [0.0; 3] { [0.0, 0.0, -1.0] } else { direction };
    (origin, direction, least, [0, 1, 2].map(|axis| least[axis] + size[axis]))
}

fn single(v: [f64; 3]) -> Vec3 {
    DVec3::from(v).as_vec3()
}

/// Exact: all these numbers have few digits.
fn slabs(least: [f64; 3], most: [f64; 3]) -> Slabs {
    let (least, most) = (DVec3::from(least), DVec3::from(most));
    let half = (most - least) / 2.0;
    Slabs::new((least + most) / 2.0, DVec3::AXES, [DVec3::X * half.x, DVec3::Y * half.y, DVec3::Z * half.z])
}
