//! Chapter 37: a point of the circle by two series.

use bevy_ecs::prelude::*;
use glam::DVec2;
use pinhole::plan::{Column, VectorRows, VectorRowsMut};
use pinhole::rays::{self, LensPoints};
use pinhole::sample::circle_point;
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Probe, Question, RowPlaces, Setting, Shown, StandIn, extremes, probes,
};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::naive::rows::{circle_by_terms, series, turned_by_quarters};
use std::f64::consts::{PI, TAU};

/// What the reader writes.
pub type Yours = fn(f64) -> [f64; 2];

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("circle", question, move |&turn| yours(turn), mine).and_in("one turn", |_| ())
}

fn question() -> Question<f64, [f64; 2]> {
    Question {
        pinhole_has: ("src/pinhole/sample/circle.rs", "circle_point"),
        probes: asked(),
        tell: |turn| format!("turn {}", turn.shown()),
        right: |&turn| circle_point(turn),
        apart: |yours, right| absolute(yours, right),
        allowed: 1e-6,
        measured: "distance",
        mistakes: Mistakes::<f64, [f64; 2]>::new()
            .say("x and y are exchanged: at 0 the point is (1, 0), and it goes up from there")
            .when(|&turn| {
                let [x, y] = circle_point(turn);
                [y, x]
            })
            .say("the fraction of a turn is taken for an angle in radians; a full turn is 2π of them")
            .when(|&turn| circle_point(turn / TAU))
            .say("a full turn is 2π, not π")
            .when(|&turn| circle_point(0.5 * turn))
            .say("the fraction of a turn is taken for an angle in degrees, or multiplied by 360 in place of 2π")
            .when(|&turn| circle_point((360.0 * turn / TAU).fract()))
            .when(|&turn| circle_point(turn / 360.0))
            .say("the point goes clockwise: y has the wrong sign")
            .when(|&turn| circle_point((1.0 - turn).fract()))
            .say("both signs are lost: the point stays in the first quarter")
            .when(|&turn| circle_point(turn).map(f64::abs))
            .say("the sign of x is lost")
            .when(|&turn| [circle_point(turn)[0].abs(), circle_point(turn)[1]])
            .say("the sign of y is lost")
            .when(|&turn| [circle_point(turn)[0], circle_point(turn)[1].abs()])
            .say("around a quarter and three quarters sine and cosine change places, and here they do not")
            .when(|&turn| in_quarters(turn, |_, [cosine, sine]| [cosine, sine]))
            .when(|&turn| {
                in_quarters(turn, |quarter, [cosine, sine]| match quarter {
                    0 => [cosine, sine],
                    1 => [-cosine, sine],
                    2 => [-cosine, -sine],
                    _ => [cosine, -sine],
                })
            })
            .say("around a quarter or three quarters of a turn a sign is wrong; the parts are those of the right quarter")
            .when(|&turn| signed_in_odd_quarters(turn, [[1.0, 1.0], [-1.0, -1.0]]))
            .when(|&turn| signed_in_odd_quarters(turn, [[1.0, 1.0], [1.0, -1.0]]))
            .when(|&turn| signed_in_odd_quarters(turn, [[-1.0, 1.0], [-1.0, -1.0]]))
            .say("the signs of the second half are those of the first")
            .when(|&turn| turned_by_quarters(libm::round(4.0 * turn) as u32 & 1, from_nearest(turn)))
            .say("a point of the wrong quarter: which is nearest is found by rounding 4 · turn, not by cutting it off")
            .when(|&turn| {
                let x = (turn - 0.25 * libm::round(4.0 * turn)) * TAU;
                turned_by_quarters(libm::floor(4.0 * turn) as u32, series(x, 8))
            })
            .say("what is left of the turn is taken without its sign, so that the point comes back on its way")
            .when(|&turn| {
                let x = (turn - 0.25 * libm::round(4.0 * turn)).abs() * TAU;
                turned_by_quarters(libm::round(4.0 * turn) as u32, series(x, 8))
            })
            .say("the series are summed up far from 0, where they need many terms; take off the nearest quarter first")
            .when(|&turn| series(TAU * turn, 2))
            .when(|&turn| series(TAU * turn, 3))
            .when(|&turn| series(TAU * turn, 4))
            .when(|&turn| series(TAU * turn, 5))
            .when(|&turn| series(TAU * turn, 6))
            .when(|&turn| series(TAU * turn, 8))
            .when(|&turn| series(TAU * turn, 10))
            .say("halves are taken off, not quarters: a quarter of a turn from 0 the series need more terms")
            .when(|&turn| in_halves(turn, 4))
            .when(|&turn| in_halves(turn, 5))
            .say("a term or two are missing: for 10⁻⁶ it takes powers up to x⁷ and x⁸, up to an eighth of a turn")
            .when(|&turn| circle_by_terms(turn, 1))
            .when(|&turn| circle_by_terms(turn, 2))
            .when(|&turn| circle_by_terms(turn, 3))
            .when(|&turn| circle_by_terms(turn, 4))
            .when(|&turn| [circle_by_terms(turn, 3)[0], circle_by_terms(turn, 5)[1]])
            .say("all terms are added; the signs of the series alternate")
            .when(|&turn| {
                let x = (turn - 0.25 * libm::round(4.0 * turn)) * TAU;
                turned_by_quarters(libm::round(4.0 * turn) as u32, [libm::cosh(x), libm::sinh(x)])
            })
            .say("the terms are not divided by the factorials of their powers")
            .when(|&turn| {
                let x = (turn - 0.25 * libm::round(4.0 * turn)) * TAU;
                let y = x * x;
                let cosine = 1.0 - y * (1.0 - y * (1.0 - y));
                turned_by_quarters(libm::round(4.0 * turn) as u32, [cosine, x * (1.0 - y * cosine)])
            })
            .say("a parabola through the right places: its values between them are off by up to 0.06")
            .when(|&turn| [parabola((turn + 0.25).fract()), parabola(turn)])
            .say("a parabola with the usual correction is near the circle, but off by up to 10⁻³")
            .when(|&turn| [corrected((turn + 0.25).fract()), corrected(turn)])
            .say("straight lines between eight places of the circle are off by up to 0.08")
            .when(|&turn| {
                let corner = |at: f64| circle_point(at / 8.0);
                let ([a, b], [c, d], part) = (corner((8.0 * turn).floor()), corner((8.0 * turn).floor() + 1.0), (8.0 * turn).fract());
                [a + (c - a) * part, b + (d - b) * part]
            })
            .say("y is computed from x by √(1 − x²), which loses its sign, and its places where x is near 1")
            .when(|&turn| {
                let [x, _] = circle_point(turn);
                [x, (1.0 - x * x).max(0.0).sqrt()]
            })
            .say("the square's corners: the point is not on the circle")
            .when(|&turn| {
                let [x, y] = circle_point(turn);
                [x, y].map(|part| part / (x.abs() + y.abs()))
            }),
        hints: &[
            "which quarter of a turn, 0 to 4, is nearest? what is left is at most an eighth, to either side",
            "in radians: sin x = x − x³/3! + x⁵/5! − …, cos x = 1 − x²/2! + x⁴/4! − …; powers up to 8 suffice",
            "a quarter of a turn further (x, y) becomes (−y, x): once, twice, three times, or not at all",
        ],
    }
}

/// Cosine and sine of what is left of a turn after the nearest quarter.
fn from_nearest(turn: f64) -> [f64; 2] {
    series((turn - 0.25 * libm::round(4.0 * turn)) * TAU, 8)
}

/// What is made of the nearest quarter, and of the cosine and sine of what is left.
fn in_quarters(turn: f64, made: fn(u32, [f64; 2]) -> [f64; 2]) -> [f64; 2] {
    made(libm::round(4.0 * turn) as u32 & 3, from_nearest(turn))
}

/// Around a quarter and around three quarters, sine and cosine with these signs.
fn signed_in_odd_quarters(turn: f64, signs: [[f64; 2]; 2]) -> [f64; 2] {
    let (quarter, [cosine, sine]) = (libm::round(4.0 * turn) as u32 & 3, from_nearest(turn));
    let [of_sine, of_cosine] = signs[quarter as usize / 2];
    match quarter {
        1 | 3 => [of_sine * sine, of_cosine * cosine],
        _ => turned_by_quarters(quarter, [cosine, sine]),
    }
}

/// After the nearest half of a turn is taken off, by this many terms.
fn in_halves(turn: f64, terms: u32) -> [f64; 2] {
    let half = libm::round(2.0 * turn);
    turned_by_quarters(2 * half as u32, series((turn - 0.5 * half) * TAU, terms))
}

/// 4x(π − x)/π², once up and once down.
fn parabola(turn: f64) -> f64 {
    let (x, sign) = if turn < 0.5 { (TAU * turn, 1.0) } else { (TAU * turn - PI, -1.0) };
    sign * 4.0 * x * (PI - x) / (PI * PI)
}

fn corrected(turn: f64) -> f64 {
    let y = parabola(turn);
    0.775 * y + 0.225 * y * y.abs()
}

fn asked() -> Vec<Probe<f64>> {
    let mut asked: Vec<_> = probes("where it starts", [0.0]).collect();
    asked.extend(probes("the quarters", [0.25, 0.5, 0.75]));
    asked.extend(probes("the first eighth", (1..8).map(|step| f64::from(step) / 64.0)));
    asked.extend(probes("the first half", (1..32).map(|step| f64::from(step) / 64.0 + 0.003)));
    asked.extend(probes("any turn", (0..200).map(|index| Draws::new(3703, index).unit())));
    let last = 1.0 - 1.0 / f64::from(1 << 24);
    asked.extend(extremes("between two quarters", [0.125, 0.375, 0.625, 0.875]));
    asked.extend(extremes("just before a full turn", [last, 1.0 - f64::EPSILON]));
    asked.extend(extremes("just after its start", [f64::MIN_POSITIVE, 1e-9]));
    asked
}

/// Points of the lens, of pinhole's distance from the middle and of the reader's direction.
fn mine(ask: Ask<f64, [f64; 2]>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::after(rays::lens_point_stage, move |mut tiles: Query<(RowPlaces, &mut LensPoints)>| {
        for (place, mut points) in &mut tiles {
            for row in 0..points.rows() {
                let [x, y] = points.point.at(row);
                let turn = (libm::atan2(y, x) / TAU).rem_euclid(1.0);
                if let Some(own) = ask.at(place, row, turn) {
                    points.point.put(row, DVec2::from(own) * libm::hypot(x, y));
                }
            }
        }
    })
}

/// A turn from left to right: x as red, y as green, and as blue how far the point is from the circle.
fn painted(ask: Ask<f64, [f64; 2]>) -> StandIn {
    StandIn::painted([64, 32], move |[x, _]| {
        let [right, up] = ask.once((f64::from(x) + 0.5) / 64.0).unwrap_or_default();
        [0.5 + 0.5 * right, 0.5 + 0.5 * up, (libm::hypot(right, up) - 1.0).abs()]
    })
}
