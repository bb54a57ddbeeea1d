//! Chapter 02: a vector brought to length 1, whatever its size.

use super::mine::mine;
use pinhole_lab::exercise::apart::{absolute, option};
use pinhole_lab::exercise::{Exercise, Mistake, Question, Shown, probes};
use pinhole_lab::measure::exact::Dyadic;
use pinhole_lab::measure::exact_vector::ExactVector;
use pinhole_lab::measure::ray_aim::Draws;

pub(super) type Vector = [f64; 3];

/// What the reader writes.
pub type Yours = fn(Vector) -> Option<Vector>;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::unit)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("unit", question, move |&v| yours(v), mine)
}

fn question() -> Question<Vector, Option<Vector>> {
    let sized = |seed, low, high| {
        (0..20).map(move |at| {
            let mut draws = Draws::new(seed, at);
            (draws.unit_vector() * draws.power_of_ten(low, high)).to_array()
        })
    };
    let (nan, infinite) = (f64::NAN, f64::INFINITY);
    let mut asked: Vec<_> = probes("a vector along an axis", [[2.0, 0.0, 0.0], [0.0, 0.0, -0.25]]).collect();
    asked.extend(probes("3, 4 and 12, of length 13", [[3.0, 4.0, 12.0], [-3.0, 4.0, -12.0]]));
    asked.extend(probes("a vector of ordinary size", sized(201, -3.0, 3.0)));
    asked.extend(probes("the vector 0, which has no direction", [[0.0; 3], [-0.0, 0.0, -0.0]]));
    asked.extend(probes("so long that its squares overflow", [[1e200, 0.0, 0.0], [-1e200, 2e200, 1e199]]));
    asked.extend(probes("so long that its squares overflow", sized(202, 160.0, 300.0)));
    asked.extend(probes("as long as f64 goes", [[f64::MAX, f64::MAX, -f64::MAX]]));
    asked.extend(probes("so short that its squares are 0", [[1e-200, 0.0, 0.0], [3e-200, -4e-200, 0.0]]));
    asked.extend(probes("so short that its squares are 0", sized(203, -300.0, -165.0)));
    asked.extend(probes("so short that its squares have few digits left", sized(204, -162.0, -155.0)));
    asked.extend(probes("subnormal", [[5e-324, 0.0, 0.0], [1.5e-323, 2e-323, 0.0], [5e-324, -5e-324, 5e-324]]));
    asked.extend(probes("with a part that is no number", [[nan, 1.0, 0.0], [0.0, 0.0, nan], [nan, nan, nan]]));
    asked.extend(probes(
        "with an infinite part",
        [[infinite, 1.0, 0.0], [0.0, -infinite, infinite], [nan, infinite, 0.0]],
    ));
    Question {
        pinhole_has: ("src/pinhole/extract/pose.rs", "fn direction"),
        probes: asked,
        tell: |v| format!("v {}", v.shown()),
        right: |&v| unit(v),
        apart: |yours, right| option(yours, right, |yours, right| absolute(yours, right)),
        allowed: 1e-15,
        measured: "in a part",
        mistakes: vec![
            Mistake::new("what has no direction is given one: 0, NaN and infinite parts must give None", |&v| {
                Some(unit(v).unwrap_or_else(|| plain(v)))
            }),
            Mistake::new("the vector is divided by its length as it stands, whose squares overflow or vanish", |&v| {
                plain(v).iter().all(|part| part.is_finite()).then(|| plain(v))
            }),
            Mistake::new("the vector is divided by its length as it stands, whose squares overflow or vanish", |&v| {
                Some(plain(v))
            }),
            Mistake::new("the vector is divided by its squared length: a square root is missing", |&v| {
                let square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
                Some(v.map(|part| part / square))
            }),
            Mistake::new("the vector is divided by its largest part, which makes that part 1, not the length", |&v| {
                let largest = largest(v);
                (largest > 0.0 && largest.is_finite()).then(|| v.map(|part| part / largest))
            }),
        ],
        hints: &[
            "divide by the length; then ask what has no direction at all",
            "squares of 1e200 and of 1e-200 do not fit in f64; but the direction of v and that of v / 1e200 are the same",
            "None for 0 and for parts that are not finite; else divide v by its largest part (without sign) first, \
             and that by its length",
        ],
    }
}

/// The exact direction, rounded once.
fn unit(v: Vector) -> Option<Vector> {
    if !v.iter().all(|part| part.is_finite()) || v == [0.0; 3] {
        return None;
    }
    let length = ExactVector::of(v).length();
    Some(v.map(|part| Dyadic::of(part).divided_by(&length).to_f64()))
}

fn plain(v: Vector) -> Vector {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|part| part / length)
}

fn largest(v: Vector) -> f64 {
    v.iter().fold(0.0, |largest, part| part.abs().max(largest))
}
