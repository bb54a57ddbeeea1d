//! Chapter 22: a direction as frequent as its cosine is large.

use super::mine::mine;
use pinhole::material::cosine_direction;
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;
use std::f64::consts::{PI, TAU};

pub(super) type Input = (f64, f64);

/// What the reader writes.
pub type Yours = fn(f64, f64) -> [f64; 3];

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::cosine_direction)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("cosine_direction", question, move |&(u, v)| yours(u, v), mine)
}

/// A direction by its radius in the disk, its turn and its height.
fn raised(radius: f64, turn: f64, height: f64) -> [f64; 3] {
    [radius * libm::cos(turn), radius * libm::sin(turn), height]
}

fn question() -> Question<Input, [f64; 3]> {
    Question {
        pinhole_has: ("src/pinhole/material/frame.rs", "cosine_direction"),
        probes: asked(),
        tell: |(u, v)| format!("u {}, v {}", u.shown(), v.shown()),
        right: |&(u, v)| cosine_direction([u, v]).into(),
        apart: |yours, right| absolute(yours, right),
        allowed: 1e-12,
        measured: "of each part",
        mistakes: vec![
            Mistake::new(
                "u is taken for the radius; the area within a radius grows as its square, so the root is missing",
                |&(u, v)| raised(u, TAU * v, (1.0 - u * u).sqrt()),
            ),
            Mistake::new("u is taken for the height: that makes all directions alike, not those near +z", |&(u, v)| {
                raised((1.0 - u * u).sqrt(), TAU * v, u)
            }),
            Mistake::new("1 − u is taken for the height: that makes all directions alike", |&(u, v)| {
                raised((u * (2.0 - u)).sqrt(), TAU * v, 1.0 - u)
            }),
            Mistake::new("v makes half a turn only; a full one is 2π", |&(u, v)| {
                raised(u.sqrt(), PI * v, (1.0 - u).sqrt())
            }),
            Mistake::new("v is taken for an angle; it is a fraction of a full turn, which is 2π", |&(u, v)| {
                raised(u.sqrt(), v, (1.0 - u).sqrt())
            }),
            Mistake::new("the height is not that of a unit vector: x² + y² is u, so z² is 1 − u", |&(u, v)| {
                raised(u.sqrt(), TAU * v, 1.0 - u)
            }),
            Mistake::new("z points down; the directions lie about +z", |&(u, v)| {
                raised(u.sqrt(), TAU * v, -(1.0 - u).sqrt())
            }),
            Mistake::new("cosine and sine of the turn are swapped: it starts at +x and goes towards +y", |&(u, v)| {
                let [x, y, z] = raised(u.sqrt(), TAU * v, (1.0 - u).sqrt());
                [y, x, z]
            }),
        ],
        hints: &[
            "choose a point of the unit disk, all of them alike, and go straight up from it to the hemisphere",
            "the fraction of the disk's area within a radius r is r², so r is the root of u; the angle is 2πv",
            "x = r cos 2πv, y = r sin 2πv, and z makes the length 1: z² = 1 − r² = 1 − u",
        ],
    }
}

fn asked() -> Vec<Probe<Input>> {
    let mut asked: Vec<_> = probes("a quarter of the disk", [(0.25, 0.1), (0.25, 0.35), (0.25, 0.8)]).collect();
    asked.extend(probes(
        "any two numbers",
        (0..60).map(|at| {
            let mut draws = Draws::new(2204, at);
            (draws.unit(), draws.unit())
        }),
    ));
    let last = 1.0 - f64::EPSILON / 2.0;
    asked.extend(probes("the pole and the rim", [(0.0, 0.0), (0.0, 0.7), (last, 0.2), (last, last)]));
    asked
}
