//! Chapter 17: where a tent filter puts a sample.

use super::mine::mine;
use pinhole::sample::{tent_offset, unit};
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;

pub(super) type Input = (f64, f64);

/// What the reader writes.
pub type Yours = fn(f64, f64) -> f64;

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
                "the root is of the area counted from the centre, not from the rim; a tent is highest in the middle",
                |i| both_sides(i, |s| s.sqrt()),
            ),
            Mistake::new("the square root is missing; the area of a triangle grows as a square", |i| {
                both_sides(i, |s| 1.0 - (1.0 - s) * (1.0 - s))
            }),
            Mistake::new("the square root is missing; the area of a triangle grows as a square", |&(u, r)| {
                if u < 0.5 { r * (2.0 * u * u - 1.0) } else { r * (1.0 - 2.0 * (1.0 - u) * (1.0 - u)) }
            }),
            Mistake::new(SQUARED, |i| both_sides(i, |s| s * s)),
            Mistake::new(SQUARED, |i| both_sides(i, |s| s * s * s)),
            Mistake::new(
                "the places grow more frequent all the way to the right rim, as under one slope; a tent falls again from the \
                 centre on",
                |&(u, r)| (2.0 * u.sqrt() - 1.0) * r,
            ),
            Mistake::new(
                "the places grow rarer all the way from the left rim, as under one slope; a tent rises up to the centre",
                |&(u, r)| (1.0 - 2.0 * (1.0 - u).sqrt()) * r,
            ),
            Mistake::new(
                "the left slope goes on beyond the centre; from u = 0.5 on, the area is that to the right, 1 − u",
                |&(u, r)| r * ((2.0 * u).sqrt() - 1.0),
            ),
            Mistake::new(
                "the right slope goes on to the left of the centre; below u = 0.5 the area is that to the left, u",
                |&(u, r)| r * (1.0 - (2.0 * (1.0 - u)).sqrt()),
            ),
            Mistake::new(MIRRORED, |i| halves(i, left, |u| 1.0 - (2.0 * u - 1.0).sqrt())),
            Mistake::new(MIRRORED, |i| halves(i, left, |u| (2.0 * u - 1.0).sqrt())),
            Mistake::new(MIRRORED, |i| halves(i, left, |u| 1.0 - (2.0 * u).sqrt())),
            Mistake::new(MIRRORED, |i| halves(i, left, |u| (2.0 * u - 1.0).sqrt() - 1.0)),
            Mistake::new(MIRRORED, |i| halves(i, left, |u| (2.0 * (1.0 - u)).sqrt())),
            Mistake::new(
                "the left half is not the mirror image of the right one: there u takes the place of 1 − u",
                |i| halves(i, |u| -(1.0 - 2.0 * u).sqrt(), |u| -left(1.0 - u)),
            ),
            Mistake::new(
                "the left half is not the mirror image of the right one: there u takes the place of 1 − u",
                |i| halves(i, |u| -(2.0 * u).sqrt(), |u| -left(1.0 - u)),
            ),
            Mistake::new(FACTOR_2, |i| halves(i, |u| u.sqrt() - 1.0, |u| 1.0 - (1.0 - u).sqrt())),
            Mistake::new(FACTOR_2, |i| halves(i, |u| (u / 2.0).sqrt() - 1.0, |u| 1.0 - ((1.0 - u) / 2.0).sqrt())),
            Mistake::new(FACTOR_2, |i| halves(i, |u| 2.0 * u.sqrt() - 1.0, |u| 1.0 - 2.0 * (1.0 - u).sqrt())),
            Mistake::new(FACTOR_2, |i| halves(i, |u| (4.0 * u).sqrt() - 1.0, |u| 1.0 - (4.0 * (1.0 - u)).sqrt())),
            Mistake::new("both halves are on one side: the lower half of u belongs to the left", |&(u, r)| {
                tent_offset(u, r).abs()
            }),
            Mistake::new("both halves are on one side: the upper half of u belongs to the right", |&(u, r)| {
                -tent_offset(u, r).abs()
            }),
            Mistake::new(
                UNDER,
                |&(u, r)| {
                    if u < 0.5 { (2.0 * r * u).sqrt() - r } else { r - (2.0 * r * (1.0 - u)).sqrt() }
                },
            ),
            Mistake::new(UNDER, |&(u, r)| {
                if u < 0.5 { r * r * (2.0 * u).sqrt() - r } else { r - r * r * (2.0 * (1.0 - u)).sqrt() }
            }),
            Mistake::new("the radius is a factor of one term only: both are in radii", |&(u, r)| {
                if u < 0.5 { r * (2.0 * u).sqrt() - 1.0 } else { 1.0 - r * (2.0 * (1.0 - u)).sqrt() }
            }),
            Mistake::new("the radius is a factor of one term only: both are in radii", |&(u, r)| {
                if u < 0.5 { (2.0 * u).sqrt() - r } else { r - (2.0 * (1.0 - u)).sqrt() }
            }),
            Mistake::new("the radius is left out: this tent always ends at 1", |&(u, _)| tent_offset(u, 1.0)),
            Mistake::new("the radius is halved; the tent ends at the radius on either side", |&(u, r)| {
                tent_offset(u, r / 2.0)
            }),
            Mistake::new("the radius is doubled; the tent ends at the radius on either side", |&(u, r)| {
                tent_offset(u, 2.0 * r)
            }),
            Mistake::new(ONE_SIDE, |&(u, r)| r * (1.0 - (1.0 - u).sqrt())),
            Mistake::new(ONE_SIDE, |&(u, r)| r * u.sqrt()),
            Mistake::new("left and right are swapped; the place must grow with u", |&(u, r)| -tent_offset(u, r)),
            Mistake::new(
                "the place is counted from the pixel's edge; asked is the distance from its centre",
                |&(u, r)| 0.5 + tent_offset(u, r),
            ),
            Mistake::new(
                "the place is counted from the tent's left end; asked is the distance from its centre",
                |&(u, r)| r + tent_offset(u, r),
            ),
            Mistake::new(HEIGHT, |&(u, r)| r * (1.0 - (2.0 * u - 1.0).abs())),
            Mistake::new(HEIGHT, |&(u, r)| 1.0 - (2.0 * u - 1.0).abs() / r),
            Mistake::new(HEIGHT, |&(u, r)| both_sides(&(u, r), |s| 1.0 - s)),
            Mistake::new("all samples land on one side; the upper half of u belongs to the right", |&(u, r)| {
                r * (u.sqrt() - 1.0)
            }),
            Mistake::new(ONE_SIDE, |&(u, r)| r * (1.0 - u.sqrt())),
            Mistake::new("the cube root is taken; the area of a triangle grows as a square", |i| {
                both_sides(i, |s| 1.0 - (1.0 - s).cbrt())
            }),
            Mistake::new("the 1 is left out: the root counts from the tent's end, not from its centre", |i| {
                halves(i, |u| (2.0 * u).sqrt(), |u| (2.0 * (1.0 - u)).sqrt())
            }),
            Mistake::new("a step of u is a step of the place: that is a box", |&(u, r)| (u - 0.5) * r),
            Mistake::new("this is how far the place is from the rim; its distance from the centre is asked for", |i| {
                both_sides(i, |s| (1.0 - s).sqrt())
            }),
            Mistake::new(FACTOR_2, |i| halves(i, |u| u.sqrt() - 1.0, |u| -left(1.0 - u))),
            Mistake::new(FACTOR_2, |i| halves(i, left, |u| 1.0 - (1.0 - u).sqrt())),
            Mistake::new("the radius is a factor twice; the tent ends at the radius on either side", |&(u, r)| {
                r * tent_offset(u, r)
            }),
            Mistake::new(UNDER, |&(u, r)| {
                if u < 0.5 { (2.0 * r * r * r * u).sqrt() - r } else { r - (2.0 * r * r * r * (1.0 - u)).sqrt() }
            }),
            Mistake::new("the place is divided by the radius; a wider tent spreads the samples", |&(u, r)| {
                tent_offset(u, 1.0) / r
            }),
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

const ONE_SIDE: &str = "all samples land on one side; the lower half of u belongs to the left";
const SQUARED: &str = "squares draw the samples to the centre too strongly: there the places become ever more \
                       frequent, a tent has a \
                       finite height";
const MIRRORED: &str =
    "the right half is not the mirror image of the left one: there 1 − u takes the place of u, and the sign changes";
const FACTOR_2: &str =
    "the 2 under the root is another number: half of the samples lie on either side, so the area there is 2u";
const UNDER: &str = "the radius is in one term without being brought out of the root as a factor of all: the tent is \
                     1 / radius high, \
                     so that its area is 1";
const HEIGHT: &str = "this is how high the tent is, not the place up to which its area is u";

/// The same function of |2u − 1| on both sides, in radii.
fn both_sides(&(u, radius): &Input, place: fn(f64) -> f64) -> f64 {
    let side = 2.0 * u - 1.0;
    (radius * place(side.abs())).copysign(side)
}

/// One function of u to the left of the centre and another to the right of it, in radii.
fn halves(&(u, radius): &Input, left: fn(f64) -> f64, right: fn(f64) -> f64) -> f64 {
    radius * if u < 0.5 { left(u) } else { right(u) }
}

fn left(u: f64) -> f64 {
    (2.0 * u).sqrt() - 1.0
}
