//! Chapter 24: where a ray hits a sphere that moves.

use super::mine::mine;
use glam::DVec3;
use pinhole::intersect::at_rest;
use pinhole::shapes::{sphere_intersection, sphere_t};
use pinhole_lab::exercise::apart::{option, relative};
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;

/// Origin, direction, centre, radius, velocity, time.
pub(super) type Input = ([f64; 3], [f64; 3], [f64; 3], f64, [f64; 3], f64);
pub(super) type Answer = Option<f64>;

/// What the reader writes.
pub type Yours = fn([f64; 3], [f64; 3], [f64; 3], f64, [f64; 3], f64) -> Answer;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::moving_sphere_t)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("moving_sphere_t", question, move |&(o, d, c, r, v, time)| yours(o, d, c, r, v, time), mine)
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
        right: |&(o, d, c, r, v, time)| nearest(at_rest(o.into(), v.into(), time), d.into(), c.into(), r),
        apart: |yours, right| option(yours, right, |yours, right| relative(&[*yours], &[*right])),
        allowed: 1e-9,
        measured: "of t",
        mistakes: vec![
            Mistake::new("the sphere stands still: its motion is left out", |&(o, d, c, r, _, _)| {
                nearest(o.into(), d.into(), c.into(), r)
            }),
            Mistake::new("the sphere moves backwards", |&(o, d, c, r, v, time)| {
                nearest(at_rest(o.into(), v.into(), -time), d.into(), c.into(), r)
            }),
            Mistake::new(
                "the time is left out: the sphere has always moved by one unit of time",
                |&(o, d, c, r, v, _)| nearest(at_rest(o.into(), v.into(), 1.0), d.into(), c.into(), r),
            ),
            Mistake::new(
                "the direction is changed by the velocity; light takes no time, so nothing moves while it travels",
                |&(o, d, c, r, v, _)| nearest(o.into(), DVec3::from(d) - DVec3::from(v), c.into(), r),
            ),
        ],
        hints: &[
            "at the ray's own time the sphere is somewhere, and there it stands still for the ray",
            "its centre is then at centre + velocity · time; the rest is chapter 3",
            "or leave the sphere and move the ray: from origin − velocity · time it hits the sphere at the same t",
        ],
    }
}

fn nearest(origin: DVec3, direction: DVec3, centre: DVec3, radius: f64) -> Answer {
    Some(sphere_t(origin, direction, centre, radius)).filter(|t| t.is_finite())
}

fn asked() -> Vec<Probe<Input>> {
    let ahead = [0.0, 0.0, -1.0];
    let ball = [0.0, 0.0, -4.0];
    let mut asked: Vec<_> = probes("a sphere at rest", [([0.0; 3], ahead, ball, 1.0, [0.0; 3], 0.5)]).collect();
    asked.extend(probes("when the shutter opens", [([0.0; 3], ahead, ball, 1.0, [3.0, 0.0, 0.0], 0.0)]));
    asked.extend(probes("a sphere that comes nearer", [([0.0; 3], ahead, ball, 1.0, [0.0, 0.0, 2.0], 0.5)]));
    asked.extend(probes("a sphere that has gone by", [([0.0; 3], ahead, ball, 1.0, [4.0, 0.0, 0.0], 0.5)]));
    asked.extend(probes(
        "a sphere that has just come",
        [([0.0; 3], ahead, [-2.0, 0.0, -4.0], 1.0, [4.0, 0.0, 0.0], 0.5)],
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
