//! Chapter 24: where a ray hits a sphere that moves.

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::MovingTable;
use pinhole::intersect;
use pinhole::intersect::{Hits, at_rest};
use pinhole::plan::{Column, Shared};
use pinhole::rays::{RayTimes, WorldRays};
use pinhole::shapes::{AnyShape, PlacedSphere, sphere_intersection, sphere_t};
use pinhole_lab::exercise::apart::{option, relative};
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Probe, Question, RowPlaces, Setting, Shown, StandIn, probes};
use pinhole_lab::measure::draws::Draws;

/// Origin, direction, centre, radius, velocity, time.
type Input = ([f64; 3], [f64; 3], [f64; 3], f64, [f64; 3], f64);

type Answer = Option<f64>;

/// What the reader writes.
pub type Yours = fn([f64; 3], [f64; 3], [f64; 3], f64, [f64; 3], f64) -> Answer;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("moving_sphere_t", question, move |&(o, d, c, r, v, time)| yours(o, d, c, r, v, time), mine)
        .and_in("ahead to behind; later", |_| ())
}

fn question() -> Question<Input, Answer> {
    Question {
        pinhole_has: ("src/pinhole/intersect/moving.rs", "at_rest"),
        probes: asked(),
        tell: |(origin, direction, centre, radius, velocity, time)| {
            let [origin, direction, centre, velocity] = [origin, direction, centre, velocity].map(Shown::shown);
            format!(
                "origin {origin}, direction {direction}, centre {centre}, radius {radius:?}, velocity {velocity}, \
                 time {time:?}"
            )
        },
        right: |input| moved(input, input.5),
        apart: |yours, right| option(yours, right, |yours, right| relative(&[*yours], &[*right])),
        allowed: 1e-9,
        measured: "of t",
        mistakes: Mistakes::<Input, Answer>::new()
            .say("only one component of the velocity counts; the sphere moves by all three")
            .when(|i| moved(&only(i, 0), i.5))
            .when(|i| moved(&only(i, 1), i.5))
            .when(|i| moved(&only(i, 2), i.5))
            .say("the direction is changed by the velocity; light takes no time, so nothing moves while it travels")
            .when(|&(o, d, c, r, v, time)| {
                nearest(o.into(), (DVec3::from(d) - time * DVec3::from(v)).normalize(), c.into(), r)
            })
            .say("the sphere counts wherever it has been until then; at the time of the ray it is in one place")
            .when(|input| swept(input, 8))
            .when(|input| swept(input, 10))
            .when(|input| swept(input, 16))
            .when(|input| swept(input, 100))
            .say("the sphere stands still: its motion is left out")
            .when(|input| moved(input, 0.0))
            .say(
                "the sphere moves backwards: its centre is at centre + velocity · time, or the origin at origin − \
                 velocity · time",
            )
            .when(|input| moved(input, -input.5))
            .when(|input| moved(input, -1.0))
            .say("the time is left out: the sphere has always moved by one unit of time")
            .when(|input| moved(input, 1.0))
            .say("the motion counts twice: move either the centre or the origin, not both")
            .when(|input| moved(input, 2.0 * input.5))
            .say("the time is squared: the velocity is constant, so the sphere moves by velocity · time")
            .when(|input| moved(input, input.5 * input.5))
            .say("the velocity's length is lost: the sphere moves by velocity · time, and velocity is no unit vector")
            .when(|&(o, d, c, r, v, time)| moved(&(o, d, c, r, DVec3::from(v).normalize_or_zero().into(), time), time))
            .say("the time is halved; the sphere moves by velocity · time")
            .when(|input| moved(input, 0.5 * input.5))
            .say("the direction is changed by the velocity; light takes no time, so nothing moves while it travels")
            .when(|input| turned(input, 0.0, -1.0))
            .when(|input| turned(input, input.5, -1.0))
            .when(|input| turned(input, input.5, 1.0))
            .when(|input| turned(input, 0.0, -input.5))
            .when(|input| turned(input, input.5, -input.5))
            .when(|input| turned(input, 0.0, 1.0))
            .say("a hit behind the ray's origin counts; t must be above 0")
            .when(|input| by_formula(input, |b, c| -b - (b * b - c).sqrt()))
            .when(|input| by_formula(input, |b, c| -b - (b * b - c).sqrt()).map(f64::abs))
            .say("that is where the ray leaves the sphere; the nearer hit is −b − √(b² − c)")
            .when(|input| by_formula(input, |b, c| -b + (b * b - c).sqrt()).filter(|&t| t > 0.0))
            .when(|input| by_formula(input, |b, c| -b + (b * b - c).sqrt()))
            .say("the sign of b is wrong: with o from the centre to the origin it is −b − √(b² − c)")
            .when(|input| by_formula(input, |b, c| b - (b * b - c).sqrt()).filter(|&t| t > 0.0))
            .when(|input| by_formula(input, |b, c| b + (b * b - c).sqrt()).filter(|&t| t > 0.0))
            .say(
                "two forms of the quadratic formula are mixed: with b = o · d it is −b − √(b² − c), and with b = 2 \
                 o · d half of −b − √(b² − 4c)",
            )
            .when(|input| by_formula(input, |b, c| (-b - (b * b - 4.0 * c).sqrt()) / 2.0).filter(|&t| t > 0.0))
            .when(|input| by_formula(input, |b, c| -b - (b * b - 4.0 * c).sqrt()).filter(|&t| t > 0.0))
            .when(|input| by_formula(input, |b, c| (-b - (b * b - c).sqrt()) / 2.0).filter(|&t| t > 0.0))
            .when(|input| by_formula(input, |b, c| -2.0 * b - (4.0 * b * b - c).sqrt()).filter(|&t| t > 0.0))
            .when(|input| by_formula(input, |b, c| -2.0 * b - (4.0 * b * b - 4.0 * c).sqrt()).filter(|&t| t > 0.0))
            .say("the root is missing: it is −b − √(b² − c)")
            .when(|input| by_formula(input, |b, c| -b - (b * b - c).sqrt().powi(2)).filter(|&t| t > 0.0))
            .say("the sign under the root is wrong: it is b² − c")
            .when(|input| by_formula(input, |b, c| -b - (b * b + c).sqrt()).filter(|&t| t > 0.0))
            .when(|input| by_formula(input, |b, c| -b - (c - b * b).sqrt()).filter(|&t| t > 0.0))
            .say("that is where the ray is closest to the sphere's centre; the hit is √(b² − c) before")
            .when(|input| by_formula(input, |b, c| if b * b < c { f64::NAN } else { -b }).filter(|&t| t > 0.0))
            .say("the radius is not squared")
            .when(|input| {
                by_formula(&with_radius(input, input.3.sqrt()), |b, c| -b - (b * b - c).sqrt()).filter(|&t| t > 0.0)
            })
            .say("the root of a negative number is NaN: where it is negative the ray misses, and the answer is None")
            .when(|input| Some(moved(input, input.5).unwrap_or(f64::NAN)))
            .say("the sphere stands still until it is hit, and only t is moved; move the centre first, then intersect")
            .when(|input| later(input, along(input) * input.5))
            .when(|input| later(input, -along(input) * input.5))
            .when(|input| later(input, input.5))
            .say("the time is added to t; t counts from the ray's origin, whenever that ray leaves")
            .when(|input| moved(input, input.5).map(|t| t + input.5))
            .say("the time is subtracted from t; t counts from the ray's origin, whenever that ray leaves")
            .when(|input| moved(input, input.5).map(|t| t - input.5).filter(|&t| t > 0.0)),
        hints: &[
            "at the ray's own time the sphere is somewhere, and there it stands still for the ray",
            "how far has it moved by then? the rest is chapter 3",
            "or leave the sphere where it is: what must be done to the ray for it to hit at the same t?",
        ],
    }
}

fn nearest(origin: DVec3, direction: DVec3, centre: DVec3, radius: f64) -> Answer {
    Some(sphere_t(origin, direction, centre, radius)).filter(|t| t.is_finite())
}

/// With this component of the velocity alone.
/// The nearest hit with the sphere at any of so many places on its way, and where it set out.
fn swept(input: &Input, places: u32) -> Answer {
    let hits = (0..=places).filter_map(|at| moved(input, input.5 * f64::from(at) / f64::from(places)));
    hits.min_by(f64::total_cmp)
}

fn only(&(o, d, c, r, v, time): &Input, axis: usize) -> Input {
    (o, d, c, r, [0, 1, 2].map(|at| if at == axis { v[at] } else { 0.0 }), time)
}

/// Where the sphere is after this time.
fn moved(&(o, d, c, r, v, _): &Input, time: f64) -> Answer {
    nearest(at_rest(o.into(), v.into(), time), d.into(), c.into(), r)
}

/// The same with so much of the velocity added to the direction.
fn turned(&(o, d, c, r, v, _): &Input, time: f64, turns: f64) -> Answer {
    moved(&(o, (DVec3::from(d) + turns * DVec3::from(v)).into(), c, r, v, time), time)
}

/// A solution of t² + 2bt + c = 0, where there is one.
fn by_formula(&(o, d, c, r, v, time): &Input, solution: fn(f64, f64) -> f64) -> Answer {
    let from_centre = at_rest(o.into(), v.into(), time) - DVec3::from(c);
    let t = solution(from_centre.dot(d.into()), from_centre.length_squared() - r * r);
    Some(t).filter(|t| !t.is_nan())
}

fn with_radius(&(o, d, c, _, v, time): &Input, radius: f64) -> Input {
    (o, d, c, radius, v, time)
}

/// The speed along the ray.
fn along(&(_, d, _, _, v, _): &Input) -> f64 {
    DVec3::from(d).dot(v.into())
}

fn later(input: &Input, by: f64) -> Answer {
    moved(input, 0.0).map(|t| t + by).filter(|&t| t > 0.0)
}

fn asked() -> Vec<Probe<Input>> {
    let ahead = [0.0, 0.0, -1.0];
    let ball = [0.0, 0.0, -4.0];
    let mut asked: Vec<_> = probes("a sphere at rest", [([0.0; 3], ahead, ball, 1.0, [0.0; 3], 0.5)]).collect();
    asked.extend(probes("when the shutter opens", [([0.0; 3], ahead, ball, 1.0, [3.0, 0.0, 0.0], 0.0)]));
    asked.extend(probes("a sphere that comes nearer", [([0.0; 3], ahead, ball, 1.0, [0.0, 0.0, 2.5], 0.3)]));
    asked.extend(probes("a sphere that has gone by", [([0.0; 3], ahead, ball, 1.0, [4.0, 0.0, 0.0], 0.5)]));
    asked.extend(probes(
        "a sphere that has just come",
        [([0.0; 3], ahead, [-2.0, 0.0, -4.0], 1.0, [4.0, 0.0, 0.0], 0.5)],
    ));
    asked.extend(probes(
        "a sphere that is behind the ray",
        [([0.0; 3], ahead, [0.0, 0.0, 4.0], 1.0, [0.0; 3], 0.5), ([0.0; 3], ahead, ball, 1.0, [0.0, 0.0, 16.0], 0.5)],
    ));
    asked.extend(probes("any sphere at any time", (0..200).map(ray).filter(decidable)));
    asked
}

/// A ray at where a moving sphere is at its time, or close beside it.
fn ray(index: u64) -> Input {
    let mut draws = Draws::new(2401, index);
    let mut point = |extent: f64| DVec3::from([0, 1, 2].map(|_| draws.between(-extent, extent)));
    let (origin, centre, velocity, beside) = (point(2.0), point(2.0) - DVec3::Z * 9.0, point(3.0), point(1.0));
    let (radius, time) = (draws.between(0.2, 1.5), draws.between(0.0, 2.0));
    let there = centre + velocity * time + beside * radius * 1.2;
    let direction = (there - origin).normalize();
    (origin.into(), direction.into(), centre.into(), radius, velocity.into(), time)
}

/// Whether the ray starts outside, and f64 can tell a hit from a miss wherever the motion is taken off.
fn decidable(&(origin, direction, centre, radius, velocity, time): &Input) -> bool {
    let from_centre = DVec3::from(centre) - at_rest(origin.into(), velocity.into(), time);
    let grazing = {
        let across = from_centre - from_centre.dot(direction.into()) * DVec3::from(direction);
        (across.length() / radius - 1.0).abs() < 1e-3
    };
    let intersection = sphere_intersection(from_centre, direction.into(), radius);
    from_centre.length() > radius * 1.01 && !grazing && !intersection.uncertain
}

/// The nearest moving shape of each ray; spheres by the reader's function.
fn mine(ask: Ask<Input, Answer>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::instead(
        intersect::moving_stage,
        move |moving: Res<Shared<MovingTable>>, mut tiles: Query<(RowPlaces, &WorldRays, &RayTimes, &mut Hits)>| {
            for (place, rays, times, mut hits) in &mut tiles {
                for row in 0..rays.rows() {
                    let (origin, direction, time) = (rays.origin_of(row), rays.direction_of(row), times.time[row]);
                    for ((body, &velocity), &shape) in moving.body.iter().zip(&moving.velocity).zip(&moving.shape) {
                        let still = at_rest(origin, velocity, time);
                        let t = match body {
                            AnyShape::Sphere(PlacedSphere { centre, radius }, ()) => {
                                // The reader is promised a direction of length 1, which f32 is not to the last digit.
                                let length = direction.length();
                                let (o, d) = (origin.into(), (direction / length).into());
                                let asked = (o, d, (*centre).into(), *radius, velocity.into(), time);
                                ask.at(place, row, asked).flatten().map_or(f64::INFINITY, |t| t / length)
                            }
                            other => other.t(still, direction),
                        };
                        if t > 0.0 && t < hits.t[row] {
                            (hits.t[row], hits.shape[row]) = (t, shape);
                        }
                    }
                }
            }
        },
    )
}

/// Rays straight at a ball that rises, from ahead of it on the left to behind it on the right, and further down later.
fn painted(ask: Ask<Input, Answer>) -> StandIn {
    StandIn::painted([64, 32], move |[x, y]| {
        let origin = [0.0, 0.5, 8.0 - 0.25 * (f64::from(x) + 0.5)];
        let asked = (origin, [0.0, 0.0, -1.0], [0.0; 3], 1.0, [0.0, 2.0, 0.0], (f64::from(y) + 0.5) / 32.0);
        let t = ask.once(asked).flatten();
        t.map_or([0.0; 3], |t| [0.1 * t, 0.5, 1.0 - 0.1 * t])
    })
}
