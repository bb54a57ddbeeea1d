//! Chapter 17: where a tent filter puts a sample.

use bevy_ecs::prelude::*;
use pinhole::extract::{FilterTable, SamplingTable, radius_of};
use pinhole::plan::{Column, Shared};
use pinhole::rays;
use pinhole::rays::{Depth, PixelSamples, RasterPoints, SampleNumber, Tile, draws_of_two};
use pinhole::sample::{Purpose, tent_offset, unit};
use pinhole::scene::Sampling;
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Probe, Question, Setting, Shown, StandIn, on_camera, probes,
};
use pinhole_lab::measure::draws::Draws;

type Input = (f64, f64);

/// What the reader writes.
pub type Yours = fn(f64, f64) -> f64;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("tent_offset", question, move |&(u, radius)| yours(u, radius), mine)
        .shown_in(|world| {
            on_camera(world, Sampling { samples: 32, seed: 17, ..Sampling::default() });
        })
        .and_in("how often each place", |_| ())
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
        mistakes: mistakes(),
        hints: &[
            "half of the samples belong to each side; take u below 1/2 for the left side, and count how much of that \
             side's area lies between the centre and the place",
            "to the right of a place x the tent leaves a triangle, similar to the whole right half: its area is \
             (1 − x / radius)² of that half's",
            "that area is known from u; set the two equal and solve for the place, and let the left side be the \
             mirror image",
        ],
    }
}

/// The sum of two numbers that are made of the first and of the other digits of one.
fn by_digits((u, radius): Input, base: f64) -> f64 {
    radius * ((u * base).floor() / base + (u * base).fract() - 1.0)
}

fn mistakes() -> Mistakes<Input, f64> {
    let low = Part::<Input, f64>::new(|i| left(i.0))
        .say("the left half is not the mirror image of the right one: there u takes the place of 1 − u")
        .when(|i| -(1.0 - 2.0 * i.0).sqrt())
        .when(|i| -(2.0 * i.0).sqrt())
        .say(FACTOR_2)
        .when(|i| i.0.sqrt() - 1.0)
        .when(|i| (i.0 / 2.0).sqrt() - 1.0)
        .when(|i| 2.0 * i.0.sqrt() - 1.0)
        .say("both halves are on one side: the lower half of u belongs to the left")
        .when(|i| -left(i.0))
        .say(FROM_THE_END)
        .when(|i| (2.0 * i.0).sqrt());
    let high = Part::<Input, f64>::new(|i| -left(1.0 - i.0))
        .say(
            "the right half is not the mirror image of the left one: there 1 − u takes the place of u, and the \
                 sign changes",
        )
        .when(|i| 1.0 - (2.0 * i.0 - 1.0).sqrt())
        .when(|i| (2.0 * i.0 - 1.0).sqrt())
        .when(|i| 1.0 - (2.0 * i.0).sqrt())
        .when(|i| (2.0 * i.0 - 1.0).sqrt() - 1.0)
        .when(|i| (2.0 * (1.0 - i.0)).sqrt())
        .say(FACTOR_2)
        .when(|i| 1.0 - (1.0 - i.0).sqrt())
        .when(|i| 1.0 - ((1.0 - i.0) / 2.0).sqrt())
        .when(|i| 1.0 - 2.0 * (1.0 - i.0).sqrt())
        .say("both halves are on one side: the upper half of u belongs to the right")
        .when(|i| left(1.0 - i.0))
        .say(FROM_THE_END)
        .when(|i| (2.0 * (1.0 - i.0)).sqrt());
    let radius = Part::<Input, f64>::new(|i| i.1)
        .say("the radius is left out: this tent always ends at 1")
        .when(|_| 1.0)
        .say("the radius is halved; the tent ends at the radius on either side")
        .when(|i| i.1 / 2.0)
        .say("the radius is doubled; the tent ends at the radius on either side")
        .when(|i| 2.0 * i.1)
        .say("the radius is a factor twice; the tent ends at the radius on either side")
        .when(|i| i.1 * i.1)
        .say("the place is divided by the radius; a wider tent spreads the samples")
        .when(|i| 1.0 / i.1);
    let whole = Part::<[f64; 4], f64>::new(tent)
        .say("left and right are swapped; the place must grow with u")
        .when(|of| -tent(of))
        .say("the place is counted from the pixel's edge; asked is the distance from its centre")
        .when(|of| 0.5 + tent(of))
        .say("the place is counted from the tent's left end; asked is the distance from its centre")
        .when(|of| of[3] + tent(of));
    Mistakes::<Input, f64>::new()
        .say("the root of what is left to 1 is subtracted from that of u; each half of the tent has a root of its own")
        .when(|&(u, radius)| radius * (u.sqrt() - (1.0 - u).sqrt()))
        .say("the digits of u are taken for two numbers; their sum is as frequent as a tent is high, but does not grow with u")
        .when(|&i| by_digits(i, 1024.0))
        .when(|&i| by_digits(i, 1000.0))
        .when(|&i| by_digits(i, 65536.0))
        .say("a step of u is a step of the place: that is a box")
        .when(|&(u, r)| (2.0 * u - 1.0) * r)
        .when(|&(u, r)| (u - 0.5) * r)
        .say("the root is of the area counted from the centre, not from the rim; a tent is highest in the middle")
        .when(|i| both_sides(i, |s| s.sqrt()))
        .say("the square root is missing; the area of a triangle grows as a square")
        .when(|i| both_sides(i, |s| 1.0 - (1.0 - s) * (1.0 - s)))
        .when(|&(u, r)| if u < 0.5 { r * (2.0 * u * u - 1.0) } else { r * (1.0 - 2.0 * (1.0 - u) * (1.0 - u)) })
        .say(
            "squares draw the samples to the centre too strongly: there the places become ever more frequent, \
                 a tent has a finite height",
        )
        .when(|i| both_sides(i, |s| s * s))
        .when(|i| both_sides(i, |s| s * s * s))
        .say(
            "the places grow more frequent all the way to the right rim, as under one slope; a tent falls \
                 again from the centre on",
        )
        .when(|&(u, r)| (2.0 * u.sqrt() - 1.0) * r)
        .say(
            "the places grow rarer all the way from the left rim, as under one slope; a tent rises up to the \
                 centre",
        )
        .when(|&(u, r)| (1.0 - 2.0 * (1.0 - u).sqrt()) * r)
        .say("the left slope goes on beyond the centre; from u = 0.5 on, the area is that to the right, 1 − u")
        .when(|&(u, r)| r * ((2.0 * u).sqrt() - 1.0))
        .say("the right slope goes on to the left of the centre; below u = 0.5 the area is that to the left, u")
        .when(|&(u, r)| r * (1.0 - (2.0 * (1.0 - u)).sqrt()))
        .say(
            "the radius is in one term without being brought out of the root as a factor of all: the tent is 1 \
                 / radius high, so that its area is 1",
        )
        .when(|i| one_term(i, |area, r| (r * area).sqrt() - r))
        .when(|i| one_term(i, |area, r| r * r * area.sqrt() - r))
        .when(|i| one_term(i, |area, r| (r * r * r * area).sqrt() - r))
        .say("the radius is a factor of one term only: both are in radii")
        .when(|i| one_term(i, |area, r| r * area.sqrt() - 1.0))
        .when(|i| one_term(i, |area, r| area.sqrt() - r))
        .say("all samples land on one side; the lower half of u belongs to the left")
        .when(|&(u, r)| r * (1.0 - (1.0 - u).sqrt()))
        .when(|&(u, r)| r * u.sqrt())
        .when(|&(u, r)| r * (1.0 - u.sqrt()))
        .say("all samples land on one side; the upper half of u belongs to the right")
        .when(|&(u, r)| r * (u.sqrt() - 1.0))
        .say("this is how high the tent is, not the place up to which its area is u")
        .when(|&(u, r)| r * (1.0 - (2.0 * u - 1.0).abs()))
        .when(|&(u, r)| 1.0 - (2.0 * u - 1.0).abs() / r)
        .when(|i| both_sides(i, |s| 1.0 - s))
        .say("the cube root is taken; the area of a triangle grows as a square")
        .when(|i| both_sides(i, |s| 1.0 - (1.0 - s).cbrt()))
        .say("this is how far the place is from the rim; its distance from the centre is asked for")
        .when(|i| both_sides(i, |s| (1.0 - s).sqrt()))
        .of_parts([Part::new(|i| i.0), low, high, radius], whole)
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

const FACTOR_2: &str =
    "the 2 under the root is another number: half of the samples lie on either side, so the area there is 2u";

/// The same function of |2u − 1| on both sides, in radii.
fn both_sides(&(u, radius): &Input, place: fn(f64) -> f64) -> f64 {
    let side = 2.0 * u - 1.0;
    (radius * place(side.abs())).copysign(side)
}

fn left(u: f64) -> f64 {
    (2.0 * u).sqrt() - 1.0
}

const FROM_THE_END: &str = "the 1 is left out: the root counts from the tent's end, not from its centre";

/// Of u, the place on the left half and that on the right one in radii, and the radius.
fn tent(&[u, low, high, radius]: &[f64; 4]) -> f64 {
    radius * if u < 0.5 { low } else { high }
}

/// The same function of the area on either side and of the radius, up from the left end or down from the right one.
fn one_term(&(u, radius): &Input, place: fn(f64, f64) -> f64) -> f64 {
    if u < 0.5 { place(2.0 * u, radius) } else { -place(2.0 * (1.0 - u), radius) }
}

/// Samples placed by the tent, with the radius of the filter that the camera has.
fn mine(ask: Ask<Input, f64>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::after(
        rays::place_samples_stage,
        move |(sampling, filter): (Res<Shared<SamplingTable>>, Res<Shared<FilterTable>>),
              (mut rows, mut points): (Local<Vec<u32>>, Local<Vec<[f64; 2]>>),
              mut tiles: Query<(&Tile, Option<&SampleNumber>, &PixelSamples, &mut RasterPoints)>| {
            let radius = radius_of(filter.filter);
            for (tile, number, samples, mut raster) in &mut tiles {
                rows.clear();
                rows.extend(0..raster.rows() as u32);
                let draws = rays::Draws {
                    sampling: &sampling,
                    tile,
                    number,
                    samples: Some(samples),
                    paths: None,
                    depth: Depth(0),
                };
                draws_of_two(&draws, Purpose::Pixel, &rows, &mut points);
                for (row, &[right, down]) in points.iter().enumerate() {
                    let [x, y] = tile.pixel_of(samples.pixel[row] as usize).map(|at| f64::from(at) + 0.5);
                    let place = (tile, Some(samples), None);
                    let offsets = [right, down].map(|u| ask.at(place, row, (u, radius)));
                    if let [Some(right), Some(down)] = offsets {
                        (raster.point[0][row], raster.point[1][row]) = (x + right, y + down);
                    }
                }
            }
        },
    )
}

/// How many of evenly spaced numbers land at each place, as columns.
fn painted(ask: Ask<Input, f64>) -> StandIn {
    const NUMBERS: usize = 9600;
    let (columns, lines, radius) = (96, 48, 1.5);
    let mut counts = vec![0.0; columns];
    for number in 0..NUMBERS {
        let place = ask.once(((number as f64 + 0.5) / NUMBERS as f64, radius)).unwrap_or_default();
        let column = ((0.25 * place + 0.5) * columns as f64).floor();
        if let Some(count) = (column >= 0.0).then(|| counts.get_mut(column as usize)).flatten() {
            *count += 1.0;
        }
    }
    // A tent is 1 / radius high.
    let full = NUMBERS as f64 * 4.0 / columns as f64 / radius;
    StandIn::painted([columns as u32, lines], move |[x, y]| {
        let height = (f64::from(lines - y) - 0.5) / f64::from(lines);
        [if height < 0.9 * counts[x as usize] / full { 0.9 } else { 0.1 }; 3]
    })
}
