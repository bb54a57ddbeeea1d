//! Chapter 22: a direction as frequent as its cosine is large.

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::SamplingTable;
use pinhole::intersect::Surfaces;
use pinhole::material::frame_of;
use pinhole::plan::{Shared, VectorRowsMut};
use pinhole::rays::{Depth, SampleNumber, draws_of_two};
use pinhole::sample::{Purpose, disk_point};
use pinhole::shade::ShadowRays;
use pinhole::{follow, rays};
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Probe, Question, RowPlaces, Setting, Shown, StandIn, extremes, probes,
};
use pinhole_lab::measure::draws::Draws;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

type Input = (f64, f64);

/// What the reader writes.
pub type Yours = fn(f64, f64) -> [f64; 3];

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("cosine_direction", question, move |&(u, v)| yours(u, v), mine)
        .and_in("where each pair leads", |_| ())
}

fn question() -> Question<Input, [f64; 3]> {
    Question {
        pinhole_has: ("src/pinhole/material/frame.rs", "cosine_direction"),
        probes: asked(),
        tell: |(u, v)| format!("u {}, v {}", u.shown(), v.shown()),
        right: |&(u, v)| raised(&[u.sqrt(), TAU * v, (1.0 - u).sqrt()]),
        apart: |yours, right| absolute(yours, right),
        allowed: 1e-12,
        measured: "of each part",
        mistakes: mistakes(),
        hints: &[
            "choose a point of the unit disk, all of them alike, and go straight up from it to the hemisphere",
            "the fraction of the disk's area within a radius r is r², so r is the root of u; the angle is 2πv",
            "two coordinates are those of the point of the disk, and the third makes the length 1",
        ],
    }
}

fn mistakes() -> Mistakes<Input, [f64; 3]> {
    let radius = Part::<Input, f64>::new(|i| i.0.sqrt()).say(RADIUS).when(|i| i.0);
    let turn = Part::<Input, f64>::new(|i| TAU * i.1)
        .say("v makes half a turn only; a full one is 2π")
        .when(|i| PI * i.1)
        .say("v is taken for an angle; it is a fraction of a full turn, which is 2π")
        .when(|i| i.1)
        .say("the turn is in degrees; cosine and sine are of radians, and a full turn is 2π")
        .when(|i| 360.0 * i.1)
        .say("the turn goes from +x towards −y; it goes towards +y")
        .when(|i| -TAU * i.1)
        .say("the turn starts at +y; it starts at +x and goes towards +y")
        .when(|i| TAU * i.1 + FRAC_PI_2);
    let height = Part::<Input, f64>::new(|i| (1.0 - i.0).sqrt())
        .say("the height is not that of a unit vector: x² + y² is u, so z² is 1 − u")
        .when(|i| 1.0 - i.0)
        .when(|i| (1.0 - i.0 * i.0).sqrt())
        .when(|i| 1.0 - i.0.sqrt())
        .when(|i| i.0.sqrt())
        .when(|i| (1.0 - i.0.sqrt()).sqrt())
        .when(|_| 1.0)
        .say("z points down; the directions lie about +z")
        .when(|i| -(1.0 - i.0).sqrt())
        .say("1 − r² loses its digits at the rim, where r is almost 1; 1 − u is the same, and exact")
        .when(|i| (1.0 - i.0.sqrt() * i.0.sqrt()).sqrt())
        .when(|i| (1.0 - i.0.sqrt() * i.0.sqrt()).max(0.0).sqrt())
        .when(|&(u, v)| {
            let [x, y, _] = raised(&[u.sqrt(), TAU * v, 0.0]);
            (1.0 - x * x - y * y).max(0.0).sqrt()
        })
        .when(|&(u, v)| {
            let [x, y, _] = raised(&[u.sqrt(), TAU * v, 0.0]);
            (1.0 - (x * x + y * y)).max(0.0).sqrt()
        })
        .when(|i| libm::cos(libm::asin(i.0.sqrt())));
    let whole = Part::<[f64; 3], [f64; 3]>::new(raised)
        .say("cosine and sine of the turn are swapped: it starts at +x and goes towards +y")
        .when(|of| {
            let [x, y, z] = raised(of);
            [y, x, z]
        })
        .say("the height is y; the directions lie about +z, so it is z")
        .when(|of| {
            let [x, y, z] = raised(of);
            [x, z, y]
        });
    Mistakes::<Input, [f64; 3]>::new()
        .say(RADIUS)
        .when(|&(u, v)| raised(&[u, TAU * v, (1.0 - u * u).sqrt()]))
        .when(|&(u, v)| raised(&[u, TAU * v, 1.0 - u]))
        .say("the radius is u squared; u is the radius squared, so take its root")
        .when(|&(u, v)| raised(&[u * u, TAU * v, (1.0 - u * u * u * u).sqrt()]))
        .say("u is taken for the angle to +z; it is an area, and the radius √u is the sine of that angle")
        .when(|&(u, v)| tilted(u * FRAC_PI_2, v))
        .when(|&(u, v)| tilted(u, v))
        .when(|&(u, v)| tilted(u * PI, v))
        .say("√u is taken for the angle to +z; it is the radius, the sine of that angle")
        .when(|&(u, v)| tilted(u.sqrt() * FRAC_PI_2, v))
        .say("u is taken for the height: that makes the directions uniform, not cosine-weighted")
        .when(|&(u, v)| raised(&[(1.0 - u * u).sqrt(), TAU * v, u]))
        .say("1 − u is taken for the height: that makes the directions uniform, not cosine-weighted")
        .when(|&(u, v)| raised(&[(u * (2.0 - u)).sqrt(), TAU * v, 1.0 - u]))
        .say("z is a cube root, which goes with the cosine squared; for the cosine itself it is the root of 1 − u")
        .when(|&(u, v)| raised(&[(1.0 - (1.0 - u).cbrt().powi(2)).max(0.0).sqrt(), TAU * v, (1.0 - u).cbrt()]))
        .say("those are directions of the whole sphere; asked are those of the hemisphere about +z")
        .when(|&(u, v)| raised(&[2.0 * (u * (1.0 - u)).sqrt(), TAU * v, 1.0 - 2.0 * u]))
        .say("u and 1 − u are swapped: u is the area nearer to the middle, so u = 0 is the pole and √u the radius")
        .when(|&(u, v)| raised(&[(1.0 - u).sqrt(), TAU * v, u.sqrt()]))
        .say("u and v are swapped: u is for the radius, and v for the turn")
        .when(|&(u, v)| raised(&[v.sqrt(), TAU * u, (1.0 - v).sqrt()]))
        .of_parts([radius, turn, height], whole)
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
    asked.extend(probes("the pole", [(0.0, 0.0), (0.0, 0.7)]));
    asked.extend(extremes("almost at the rim", [(last, 0.2), (last, last)]));
    asked
}

const RADIUS: &str = "u is taken for the radius; the area within a radius grows as its square, so the root is missing";

/// A direction by its radius in the disk, its turn and its height.
fn raised(&[radius, turn, height]: &[f64; 3]) -> [f64; 3] {
    [radius * libm::cos(turn), radius * libm::sin(turn), height]
}

/// A direction by its angle to +z and its turn.
fn tilted(angle: f64, v: f64) -> [f64; 3] {
    raised(&[libm::sin(angle), TAU * v, libm::cos(angle)])
}

/// Directions about the normal, in which the open sky is looked for.
fn mine(ask: Ask<Input, [f64; 3]>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::after(
        follow::sky_rays_stage,
        move |sampling: Res<Shared<SamplingTable>>,
              mut points: Local<Vec<[f64; 2]>>,
              mut tiles: Query<(RowPlaces, Option<&SampleNumber>, &Surfaces, &mut ShadowRays)>| {
            for (place, number, surfaces, mut rays) in &mut tiles {
                let (tile, samples, _) = place;
                let draws = rays::Draws { sampling: &sampling, tile, number, samples, paths: None, depth: Depth(0) };
                draws_of_two(&draws, Purpose::Direction, &rays.row, &mut points);
                for (ray, &drawn) in points.iter().enumerate() {
                    let row = rays.row[ray] as usize;
                    if let Some(own) = ask.at(place, row, polar(drawn)) {
                        let direction = frame_of(surfaces.get(row).normal.as_dvec3()) * DVec3::from(own);
                        rays.direction.put(ray, direction.as_vec3());
                    }
                }
            }
        },
    )
}

/// The area nearer to the middle than pinhole's point of the disk, and its turn.
fn polar(drawn: [f64; 2]) -> Input {
    let on_disk = disk_point(drawn);
    let [x, y] = on_disk.point();
    (on_disk.squared(), (libm::atan2(y, x) / TAU).rem_euclid(1.0))
}

/// The direction for each pair of numbers: u to the right, v down.
fn painted(ask: Ask<Input, [f64; 3]>) -> StandIn {
    StandIn::painted([64, 32], move |[x, y]| {
        let direction = ask.once(((f64::from(x) + 0.5) / 64.0, (f64::from(y) + 0.5) / 32.0)).unwrap_or_default();
        direction.map(|part| 0.5 + 0.5 * part)
    })
}
