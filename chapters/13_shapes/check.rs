//! Chapter 13: where a ray first hits a box, compared with exact arithmetic.

use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use pinhole::extract::CuboidTable;
use pinhole::intersect;
use pinhole::intersect::Hits;
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole::shapes::Slabs;
use pinhole_lab::exercise::apart::{option, relative};
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Probe, Question, RowPlaces, Setting, Shown, StandIn, extremes, probes,
};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::oracle_cuboid::cuboid_hit;

/// Origin, direction, min and max; all with few digits, so that quotients that are equal come out equal.
type Input = ([f64; 3], [f64; 3], [f64; 3], [f64; 3]);

type Answer = Option<f64>;
/// From where to where a ray is inside.
type Span = Option<[f64; 2]>;

/// What the reader writes.
pub type Yours = fn([f64; 3], [f64; 3], [f64; 3], [f64; 3]) -> Answer;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("nearest_box_t", question, move |&(o, d, min, max)| yours(o, d, min, max), mine)
        .and_in("edges; below, from inside", |_| ())
}

fn question() -> Question<Input, Answer> {
    Question {
        pinhole_has: ("src/pinhole/shapes/cuboid.rs", "fn slab"),
        probes: asked(),
        tell: |(origin, direction, min, max)| {
            let [origin, direction, min, max] = [origin, direction, min, max].map(Shown::shown);
            format!("origin {origin}, direction {direction}, min {min}, max {max}")
        },
        right: |&(o, d, min, max)| cuboid_hit(single(o), single(d), &slabs(min, max)).map(|(t, _)| t.to_f64()),
        apart: |yours, right| option(yours, right, |yours, right| relative(&[*yours], &[*right])),
        allowed: 1e-12,
        measured: "of t",
        mistakes: mistakes(),
        hints: &[
            "a box is what three slabs have in common: min ≤ x ≤ max for each coordinate by itself",
            "the ray crosses the two faces of a slab at (min − o) / d and (max − o) / d; it enters at the smaller of \
             the two and leaves at the larger",
            "it is inside the box from the largest of the three entries to the smallest of the three exits, if the one \
             is not beyond the other",
            "two cases are left: a ray along a slab is in it always or never; and one that begins inside has its \
             entry behind it",
        ],
    }
}

fn mistakes() -> Mistakes<Input, Answer> {
    let inside = Part::<Input, Span>::new(span)
        .say("the slab is entered at its smaller coordinate; where the direction is negative it is left there")
        .when(|i| by_slabs(i, Zero::Divided, &|t, _| t, &common))
        .when(|i| by_slabs(i, Zero::Checked, &|t, _| t, &common))
        .say("the slab is entered at its larger coordinate; where the direction is positive it is left there")
        .when(|i| by_slabs(i, Zero::Checked, &|[low, high], _| [high, low], &common))
        .say(
            "near and far are told apart by the direction's sign, which a zero below zero has not when it is \
                 compared: take the smaller and the larger quotient",
        )
        .when(|i| {
            by_slabs(i, Zero::Divided, &|[low, high], d| if d >= 0.0 { [low, high] } else { [high, low] }, &common)
        })
        .when(|i| {
            by_slabs(i, Zero::Divided, &|[low, high], d| if d > 0.0 { [low, high] } else { [high, low] }, &common)
        })
        .say("the ray is taken to be inside while any slab has it; the box is what all three have in common")
        .when(|i| by_slabs(i, Zero::Divided, &sorted, &|a, b| [a[0].min(b[0]), a[1].max(b[1])]))
        .when(|i| by_slabs(i, Zero::Skipped, &sorted, &|a, b| [a[0].min(b[0]), a[1].max(b[1])]))
        .say("the ray is inside until it leaves the last slab; it leaves the box with the first slab")
        .when(|i| {
            by_slabs(i, Zero::Checked, &sorted, &|a, b| {
                [a[0].max(b[0]), if a[1].is_infinite() { b[1] } else { a[1].max(b[1]) }]
            })
        })
        .say("the ray is inside from where it enters the first slab; it enters the box with the last slab")
        .when(|i| {
            by_slabs(i, Zero::Checked, &sorted, &|a, b| {
                [if a[0].is_infinite() { b[0] } else { a[0].min(b[0]) }, a[1].min(b[1])]
            })
        })
        .say("an axis along which the direction is 0 is left out; the ray may run beside that slab")
        .when(|i| by_slabs(i, Zero::Skipped, &sorted, &common))
        .say("whether the ray leaves before it enters is never asked; then it misses the box")
        .when(|i| spans(i, Zero::Checked, &sorted, &common))
        .when(|i| spans(i, Zero::Divided, &sorted, &common))
        .say("a ray through an edge or in a face is lost: they belong to the box, so compare with ≤")
        .when(|i| span(i).filter(|[enters, leaves]| enters < leaves))
        .say("z is left out: a box has three slabs")
        .when(|i| {
            let far = |v: [f64; 3], z| [v[0], v[1], z];
            by_slabs(&(i.0, far(i.1, 0.0), far(i.2, f64::MIN), far(i.3, f64::MAX)), Zero::Checked, &sorted, &common)
        })
        .say(
            "a ray in the plane of a face is lost: 0 by 0 is not a number, or what lies in that plane is taken \
                 to be outside",
        )
        .when(|i| by_slabs(i, Zero::Divided, &sorted, &common))
        .when(|i| by_slabs(i, Zero::Lost, &sorted, &common))
        .when(|i| by_slabs(i, Zero::Within, &sorted, &common))
        .when(|i| {
            let larger = |a: f64, b: f64| if b > a || a.is_nan() { b } else { a };
            by_slabs(i, Zero::Divided, &|[a, b], _| if a > b { [b, a] } else { [a, b] }, &|a, b| {
                [larger(a[0], b[0]), -larger(-a[1], -b[1])]
            })
        })
        .say("a direction of 0 along an axis is taken for a miss: between that axis's faces, all t will do")
        .when(|i| by_slabs(i, Zero::Missed, &sorted, &common))
        .say("the faces are put a whole size from the centre; half the size is meant")
        .when(|&(o, d, l, m)| {
            let half = (DVec3::from(m) - DVec3::from(l)) / 2.0;
            let (min, max) = ((DVec3::from(l) - half).into(), (DVec3::from(m) + half).into());
            by_slabs(&(o, d, min, max), Zero::Checked, &sorted, &common)
        });
    let hit = Part::<[Span; 1], Answer>::new(|&[span]| ahead(span))
        .say("what lies behind the origin is hit too: only t above 0 counts")
        .when(|&[span]| span.map(|[enters, _]| enters))
        .when(|&[span]| span.map(|[enters, leaves]| if enters > 0.0 { enters } else { leaves }))
        .when(|&[span]| span.filter(|[_, leaves]| *leaves > 0.0).map(|[enters, _]| enters))
        .when(|&[span]| span.map(|[enters, leaves]| enters.abs().min(leaves.abs())))
        .say("from inside, nothing is hit: the ray entered behind the origin, but it leaves ahead")
        .when(|&[span]| span.map(|[enters, _]| enters).filter(|&t| t > 0.0))
        .say("from inside, the origin counts as the hit; the ray hits the box where it leaves")
        .when(|&[span]| span.filter(|[_, leaves]| *leaves >= 0.0).map(|[enters, _]| enters.max(0.0)))
        .say("the far side is taken where the near one is ahead")
        .when(|&[span]| span.map(|[_, leaves]| leaves).filter(|&t| t > 0.0))
        .say("t = 0 counts as a hit; only t above 0 does")
        .when(|&[span]| span?.into_iter().find(|&t| t >= 0.0));
    Mistakes::<Input, Answer>::new()
        .asked_as_given()
        .say("only two of the three slabs are looked at; the ray must be in all of them at once")
        .when(|i| ahead(span(&without(i, 0))))
        .when(|i| ahead(span(&without(i, 1))))
        .when(|i| ahead(span(&without(i, 2))))
        .say("`max` is taken for the box's size; it is the corner with the larger coordinates")
        .when(|&(o, d, min, max)| ahead(span(&(o, d, min, (DVec3::from(min) + DVec3::from(max)).into()))))
        .say("a ray through an edge or in a face is lost: they belong to the box, so compare with ≤")
        .when(|i| faces_hit(i, |min, at, max| min < at && at < max).reduce(f64::min))
        .say(
            "the direction is brought to length 1 and t is left so; t counts in lengths of the direction as it \
                 was given",
        )
        .when(|i| ahead(span(i)).map(|t| t * DVec3::from(i.1).length()))
        .say("the ray is not yet inside where it enters the first slab, only where it enters the last slab")
        .when(|input| {
            let &(o, d, min, max) = input;
            span(input)?;
            let near = |axis: usize| f64::min((min[axis] - o[axis]) / d[axis], (max[axis] - o[axis]) / d[axis]);
            (0..3).filter(|&axis| d[axis] != 0.0).map(near).filter(|&t| t > 0.0).reduce(f64::min)
        })
        .say("the nearest of the six planes counts, though the ray may hit it beside the box")
        .when(|&(o, d, l, m)| {
            let of_axis = |axis: usize| [l, m].map(|face| (face[axis] - o[axis]) / d[axis]);
            (0..3).flat_map(of_axis).filter(|t| *t > 0.0 && t.is_finite()).reduce(f64::min)
        })
        .say("the first or last face that is found counts; the ray hits two of them, and the nearer one is meant")
        .when(|i| faces_hit(i, |min, at, max| min <= at && at <= max).last())
        .when(|i| faces_hit(i, |min, at, max| min <= at && at <= max).next())
        .of_parts([inside], hit)
}

/// What is done with a direction that is 0 along an axis.
#[derive(Clone, Copy, PartialEq)]
enum Zero {
    /// Whether the ray runs between the faces, or in one.
    Checked,
    /// The same, but not in one.
    Within,
    /// Divided by, and what is not a number is passed over.
    Divided,
    /// Divided by, and what is not a number is a miss.
    Lost,
    Skipped,
    Missed,
}

/// From where to where a ray is inside: of each slab's quotients, and of the slabs together.
fn spans(
    &(o, d, min, max): &Input,
    zero: Zero,
    of_slab: &dyn Fn([f64; 2], f64) -> [f64; 2],
    together: &dyn Fn([f64; 2], [f64; 2]) -> [f64; 2],
) -> Span {
    let mut span: Span = None;
    for axis in 0..3 {
        if d[axis] == 0.0 && !matches!(zero, Zero::Divided | Zero::Lost) {
            let outside = o[axis] < min[axis] || o[axis] > max[axis];
            let in_face = o[axis] == min[axis] || o[axis] == max[axis];
            match zero {
                Zero::Missed => return None,
                Zero::Checked | Zero::Within if outside => return None,
                Zero::Within if in_face => return None,
                _ => continue,
            }
        }
        let quotients = [min, max].map(|face| (face[axis] - o[axis]) / d[axis]);
        if zero == Zero::Lost && quotients.iter().any(|t| t.is_nan()) {
            return None;
        }
        let slab = of_slab(quotients, d[axis]);
        span = Some(span.map_or(slab, |span| together(span, slab)));
    }
    span
}

/// The same, and nothing where the ray leaves before it enters.
fn by_slabs(
    input: &Input,
    zero: Zero,
    of_slab: &dyn Fn([f64; 2], f64) -> [f64; 2],
    together: &dyn Fn([f64; 2], [f64; 2]) -> [f64; 2],
) -> Span {
    spans(input, zero, of_slab, together).filter(|[enters, leaves]| enters <= leaves)
}

fn sorted([low, high]: [f64; 2], _: f64) -> [f64; 2] {
    [low.min(high), low.max(high)]
}

fn common(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].max(b[0]), a[1].min(b[1])]
}

fn span(input: &Input) -> Span {
    by_slabs(input, Zero::Checked, &sorted, &common)
}

/// With a slab so wide that everything is in it.
fn without(&(o, d, mut min, mut max): &Input, axis: usize) -> Input {
    (min[axis], max[axis]) = (f64::NEG_INFINITY, f64::INFINITY);
    (o, d, min, max)
}

fn ahead(span: Span) -> Answer {
    span?.into_iter().find(|&t| t > 0.0)
}

/// Where the ray hits a face, face by face: whether a coordinate is between the other faces is told by a function.
fn faces_hit(&(o, d, min, max): &Input, between: fn(f64, f64, f64) -> bool) -> impl Iterator<Item = f64> {
    let faces = (0..3).flat_map(move |axis| [min, max].map(|face| (axis, (face[axis] - o[axis]) / d[axis])));
    let is_hit = move |&(axis, t): &(usize, f64)| {
        let is_within = |other| other == axis || between(min[other], o[other] + t * d[other], max[other]);
        t > 0.0 && t.is_finite() && (0..3).all(is_within)
    };
    faces.filter(is_hit).map(|(_, t)| t)
}

fn asked() -> Vec<Probe<Input>> {
    let (min, max) = ([-1.0, -2.0, -4.0], [1.0, 2.0, -2.0]);
    let at = |origin, direction| (origin, direction, min, max);
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
    asked.extend(probes("beside a face", [at([1.125, 0.5, 0.0], [0.0, 0.0, -1.0])]));
    asked
        .extend(probes("at an edge", [at([3.0, 0.0, 0.0], [-1.0, 0.0, -1.0]), at([0.0, 4.0, 0.0], [0.0, -1.0, -1.0])]));
    asked.extend(probes(
        "touching an edge",
        [at([0.0, 3.0, -3.0], [1.0, -1.0, 0.0]), at([0.0, 0.0, -5.0], [-1.0, 0.0, 1.0])],
    ));
    asked.extend(probes("from a face, outward", [at([1.0, 0.0, -3.0], [1.0, 0.0, 0.0])]));
    asked.extend(probes("from a face, inward", [at([1.0, 0.0, -3.0], [-1.0, 0.0, 0.0])]));
    let (in_faces, others): (Vec<Input>, _) = (0..200).map(drawn).partition(is_in_face);
    asked.extend(probes("anything", others));
    asked.extend(extremes(
        "along a face",
        [at([1.0, 0.5, 0.0], [0.0, 0.0, -1.0]), at([-3.0, 2.0, -3.0], [1.0, -0.0, 0.0])],
    ));
    asked.extend(extremes("along an edge", [at([1.0, 2.0, 0.0], [0.0, 0.0, -1.0])]));
    asked.extend(extremes("anything in the plane of a face", in_faces));
    asked
}

/// Whether the ray runs in the plane of a face, where the textbook's formula divides 0 by 0.
fn is_in_face(&(o, d, min, max): &Input) -> bool {
    (0..3).any(|axis| d[axis] == 0.0 && (o[axis] == min[axis] || o[axis] == max[axis]))
}

/// A box and a ray of numbers with few digits, mostly at it; directions are powers of two or 0, so that no quotient rounds.
fn drawn(index: u64) -> Input {
    let mut draws = Draws::new(313, index);
    let mut step = |range: f64| (draws.unit() * range * 2.0 - range).round() / 8.0;
    let min = [step(32.0), step(32.0), step(32.0)];
    let size = [step(16.0), step(16.0), step(16.0)].map(|part| part.abs() + 0.125);
    let origin = [step(64.0), step(64.0), step(64.0)];
    let direction = [step(20.0), step(20.0), step(20.0)].map(|part: f64| match part.abs() {
        small if small < 0.5 => 0.0 * part,
        middle if middle < 1.5 => part.signum(),
        _ => 2.0 * part.signum(),
    });
    let direction = if direction == [0.0; 3] { [0.0, 0.0, -1.0] } else { direction };
    (origin, direction, min, [0, 1, 2].map(|axis| min[axis] + size[axis]))
}

fn single(v: [f64; 3]) -> Vec3 {
    DVec3::from(v).as_vec3()
}

/// Exact: all these numbers have few digits.
fn slabs(min: [f64; 3], max: [f64; 3]) -> Slabs {
    let (min, max) = (DVec3::from(min), DVec3::from(max));
    let half = (max - min) / 2.0;
    Slabs::new((min + max) / 2.0, DVec3::AXES, [DVec3::X * half.x, DVec3::Y * half.y, DVec3::Z * half.z])
}

/// The nearest cuboid of each ray, each asked in its own axes about its own centre.
fn mine(ask: Ask<Input, Answer>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::instead(
        intersect::cuboid_stage,
        move |cuboids: Res<Shared<CuboidTable>>, mut tiles: Query<(RowPlaces, &WorldRays, &mut Hits)>| {
            for (place, rays, mut hits) in &mut tiles {
                for row in 0..rays.rows() {
                    for (slabs, &shape) in cuboids.row.iter().zip(&cuboids.shape) {
                        let own = |v: DVec3| slabs.normal.map(|normal| normal.dot(v));
                        let (origin, direction) =
                            (own(rays.origin_of(row) - slabs.centre), own(rays.direction_of(row)));
                        let asked = (origin, direction, slabs.half.map(|half| -half), slabs.half);
                        let t = ask.at(place, row, asked).flatten();
                        if let Some(t) = t.filter(|t| *t > 0.0 && *t < hits.t[row]) {
                            (hits.t[row], hits.shape[row]) = (t, shape);
                        }
                    }
                }
            }
        },
    )
}

/// Rays straight on, also along edges of a cube: in the upper half from outside, in the lower half from inside.
fn painted(ask: Ask<Input, Answer>) -> StandIn {
    StandIn::painted([17, 18], move |[x, y]| {
        let [right, up] = [0.25 * f64::from(x) - 2.0, 0.4 * (4.0 - f64::from(y % 9))];
        let origin = [right, up, if y < 9 { 3.0 } else { 0.25 }];
        let t = ask.once((origin, [0.0, 0.0, -1.0], [-1.0; 3], [1.0; 3])).flatten();
        t.map_or([0.0; 3], |t| [0.25 * t, 0.5, 1.0 - 0.25 * t])
    })
}
