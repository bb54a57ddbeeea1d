//! Chapter 17: where a tent filter puts a sample.

use super::mine::mine;
use pinhole::sample::{tent_offset, unit};
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;

pub(super) type Input = (f64, f64);

/// What the reader writes.
pub type Yours = fn(f64, f64) -> f64;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::tent_offset)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("tent_offset", question, move |&(u, radius)| yours(u, radius), mine)
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/filters/tent.rs", "tent_offset"),
        probes: asked(),
        tell: |(u, radius)| format!("u {}, radius {}", u.shown(), radius.shown()),
        right: |&(u, radius)| tent_offset(u, radius),
        apart: |yours, right| absolute(&[*yours], &[*right]),
        allowed: 1e-12,
        measured: "pixels",
        mistakes: vec![
            Mistake::new("a step of u is a step of the place: that is a box", |&(u, r)| (2.0 * u - 1.0) * r),
            Mistake::new(
                "the area is counted from the rim, so that most samples land there; a tent is highest in the middle",
                |&(u, r)| {
                    let side = 2.0 * u - 1.0;
                    (r * side.abs().sqrt()).copysign(side)
                },
            ),
            Mistake::new("the square root is missing; the area of a triangle grows as a square", |&(u, r)| {
                let side = 2.0 * u - 1.0;
                (r * (1.0 - (1.0 - side.abs()) * (1.0 - side.abs()))).copysign(side)
            }),
            Mistake::new("the radius is left out: this tent always ends at 1", |&(u, _)| tent_offset(u, 1.0)),
            Mistake::new("all samples land on one side; the lower half of u belongs to the left", |&(u, r)| {
                r * (1.0 - (1.0 - u).sqrt())
            }),
            Mistake::new("left and right are swapped; the place must grow with u", |&(u, r)| -tent_offset(u, r)),
            Mistake::new(
                "the place is counted from the pixel's edge; asked is the distance from its centre",
                |input| 0.5 + tent_offset(input.0, input.1),
            ),
        ],
        hints: &[
            "half of the samples belong to each side; take u below 1/2 for the left side, and count how much of that \
             side's area lies between the centre and the place",
            "to the right of a place x the tent leaves a triangle, similar to the whole right half: its area is \
             (1 − x / radius)² of that half's",
            "with s = 2u − 1 the place has the sign of s, and (1 − |x| / radius)² = 1 − |s|; solve for |x|",
        ],
    }
}

fn asked() -> Vec<Probe<Input>> {
    let largest = unit(u32::MAX);
    let mut asked: Vec<_> = probes("a quarter, and three quarters", [(0.25, 1.0), (0.75, 1.0)]).collect();
    asked.extend(probes(
        "a radius of 1",
        (0..40).map(|at| {
            let mut draws = Draws::new(1704, at);
            (draws.unit(), 1.0)
        }),
    ));
    asked.extend(probes(
        "another radius",
        (0..40).map(|at| {
            let mut draws = Draws::new(1705, at);
            (draws.unit(), draws.between(0.25, 4.0))
        }),
    ));
    asked.extend(probes("the middle", [(0.5, 1.0), (0.5, 2.0)]));
    asked.extend(probes("the ends", [(0.0, 1.0), (largest, 1.0), (0.0, 2.5), (largest, 2.5)]));
    asked
}
