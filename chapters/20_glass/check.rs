//! Chapter 20: a direction through a surface of glass, where there is one.

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::GlassTable;
use pinhole::follow::{Scattered, split_stage};
use pinhole::intersect::Surfaces;
use pinhole::material::{SmoothGlass, refract};
use pinhole::plan::{Column, Shared, VectorRowsMut};
use pinhole::rays::WorldRays;
use pinhole_lab::exercise::apart::{absolute, option};
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Probe, Question, RowPlaces, Setting, Shown, StandIn, probes};
use pinhole_lab::measure::draws::Draws;

type Vector = [f64; 3];

/// A direction, a normal, and the far side's index of refraction over the near side's.
type Input = (Vector, Vector, f64);

/// What the reader writes.
pub type Yours = fn(Vector, Vector, f64) -> Option<Vector>;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("refracted", question, move |&(direction, normal, eta)| yours(direction, normal, eta), mine)
        .and_in("angles; down: denser", |_| ())
}

fn question() -> Question<Input, Option<Vector>> {
    Question {
        pinhole_has: ("src/pinhole/material/fresnel.rs", "refract"),
        probes: asked(),
        tell: |(direction, normal, eta)| {
            format!("direction {}, normal {}, eta {eta:?}", direction.shown(), normal.shown())
        },
        right: |&(direction, normal, eta)| refract(direction.into(), normal.into(), eta).map(Into::into),
        apart: |yours, right| option(yours, right, |yours, right| absolute(yours, right)),
        allowed: 1e-9,
        measured: "in a part",
        mistakes: Mistakes::<Input, Option<Vector>>::new()
            .say("direction and normal are swapped")
            .when(|i| refract(i.1.into(), i.0.into(), i.2).map(Into::into))
            .say("only d is divided by η, and (c − g) n is not; the whole sum is")
            .when(|i| Some((DVec3::from(i.0) / i.2 + (cosine(i) - root(squared(i))?) * DVec3::from(i.1)).into()))
            .say("c is left out of (c − g) n: it takes off what d has along the normal, and g puts back what is right there")
            .when(|i| bent(i, -root(squared(i))?))
            .say("only (c − g) n is divided by η, and d is not; the whole sum is")
            .when(|i| Some((DVec3::from(i.0) + (cosine(i) - root(squared(i))?) / i.2 * DVec3::from(i.1)).into()))
            .say("1 less the sine is taken for the cosine; it is √(1 − sin²)")
            .when(|i| {
                let sine = root(1.0 - cosine(i) * cosine(i))? / i.2;
                if sine > 1.0 { None } else { parts(i, 1.0 / i.2, 1.0 - sine) }
            })
            .say("the part along the normal is left out: (c − g) n bends the direction, and the length stays 1")
            .when(|i| root(squared(i)).map(|_| (DVec3::from(i.0) / i.2).into()))
            .say("c is not squared under the root: g² is η² − 1 + c²")
            .when(|i| bent(i, cosine(i) - root(i.2 * i.2 - 1.0 + cosine(i))?))
            .say("only g is divided by η, and then all is normalised; d and c are to be divided by it, too")
            .when(|i| {
                Some((DVec3::from(i.0) + (cosine(i) - root(squared(i))? / i.2) * DVec3::from(i.1)).normalize().into())
            })
            .say("the root of a negative number is NaN: ask before you take it, and answer None")
            .when(|i| {
                let (d, n) = (DVec3::from(i.0), DVec3::from(i.1));
                Some(((d + (cosine(i) - squared(i).sqrt()) * n) / i.2).into())
            })
            .say("η is inverted: it is the far side's index over the near side's")
            .when(|i| refract(i.0.into(), i.1.into(), 1.0 / i.2).map(Into::into))
            .say("under the root η is inverted: √(1 − sin² / η²) is the cosine on the far side")
            .when(|i| {
                let c = cosine(i);
                parts(i, 1.0 / i.2, root(1.0 - i.2 * i.2 * (1.0 - c * c))?)
            })
            .say("under the root η is inverted: it is η² − 1 + c², and then (c − g) n is divided by η")
            .when(|i| {
                let c = cosine(i);
                bent(i, c - root(1.0 / (i.2 * i.2) - 1.0 + c * c)?)
            })
            .say("the minus is missing: the direction comes towards the surface, so c is −d · n")
            .when(|i| bent(i, -cosine(i) - root(squared(i))?))
            .when(|i| bent(i, -cosine(i) + root(squared(i))?))
            .say("what comes out goes back to the near side: the normal's part must point into the surface")
            .when(|i| bent(i, cosine(i) + root(squared(i))?))
            .say("the whole sum is to be divided by η; g = √(η² − 1 + c²) is η times the far cosine")
            .when(|i| parts(i, 1.0 / i.2, root(squared(i))?))
            .say("nothing is divided by η: what comes out is not of length 1")
            .when(|i| parts(i, 1.0, root(squared(i))?))
            .say("the part along the surface is multiplied by η; Snell's law divides it")
            .when(|i| parts(i, i.2, root(squared(i))? / i.2))
            .say("only the part along the surface is divided by η; the other follows from the length of 1")
            .when(|i| parts(i, 1.0 / i.2, cosine(i)))
            .say(
                "the two parts are normalised together; the part along the surface is exactly that of before over \
                 η, and the other makes the length 1",
            )
            .when(|i| parts(i, 1.0 / i.2, cosine(i)).map(|bent| DVec3::from(bent).normalize().into()))
            .say("the angle is divided by η; Snell's law divides its sine")
            .when(by_angle)
            .say("the cosine is taken for the sine: g² is η² − 1 + c²")
            .when(|i| bent(i, cosine(i) - root(i.2 * i.2 - cosine(i) * cosine(i))?))
            .say("the root is missing: g is √(η² − 1 + c²)")
            .when(|i| bent(i, cosine(i) - root(squared(i)).map(|_| squared(i))?))
            .say("it is the sine of the far angle that goes against the normal, which is for its cosine")
            .when(|i| parts(i, 1.0 / i.2, root(squared(i)).map(|_| (1.0 - cosine(i).powi(2)).max(0.0).sqrt())? / i.2))
            .say("η is not squared under the root: g² is η² − 1 + c²")
            .when(|i| bent(i, cosine(i) - root(i.2 - 1.0 + cosine(i) * cosine(i))?))
            .say("η is not squared under the root: the cosine on the far side is √(1 − sin² / η²)")
            .when(|i| parts(i, 1.0 / i.2, root(1.0 - (1.0 - cosine(i) * cosine(i)) / i.2)?))
            .say("the signs under the root are wrong: g² is η² − 1 + c²")
            .when(|i| bent(i, cosine(i) - root(1.0 - i.2 * i.2 + cosine(i) * cosine(i))?))
            .say(
                "nothing is to be turned round or inverted where η is below 1: the normal is on the side that the \
                 light comes from",
            )
            .when(|i| {
                if i.2 < 1.0 { bent(i, cosine(i) + root(squared(i))?) } else { bent(i, cosine(i) - root(squared(i))?) }
            })
            .when(|i| refract(i.0.into(), i.1.into(), i.2.max(1.0 / i.2)).map(Into::into))
            .when(|i| refract(i.0.into(), if i.2 < 1.0 { -DVec3::from(i.1) } else { i.1.into() }, i.2).map(Into::into))
            .say("out of a medium of a higher index some light passes, too: None only where g² is below 0")
            .when(|i| if i.2 < 1.0 { None } else { bent(i, cosine(i) - root(squared(i))?) })
            .say("the part along the surface stays as it is; by Snell's law it is divided by η")
            .when(|i| parts(i, 1.0, root(squared(i))? / i.2))
            .say("the direction goes straight on")
            .when(|i| Some(i.0))
            .say(
                "where nothing passes the mirror's direction is given; what is reflected is not asked for, so it \
                 is None",
            )
            .when(|i| refracted_or(i, |i| DVec3::from(i.0) + 2.0 * cosine(i) * DVec3::from(i.1)))
            .say("where nothing passes there is no direction: answer None")
            .when(|i| refracted_or(i, |i| i.0.into()))
            .when(|i| refracted_or(i, |_| DVec3::ZERO))
            .say("a root of a negative number is cut off at 0; where it is negative, nothing passes: None")
            .when(|i| bent(i, cosine(i) - squared(i).max(0.0).sqrt())),
        hints: &[
            "split the direction into a part along the surface, d + (−d · n) n, and a part along the normal",
            "by Snell's law the part along the surface is divided by η; the part along the normal makes the length 1 \
             again, if it can",
            "how long may the part along the surface become? beyond that no light passes",
        ],
    }
}

/// Between the normal and the direction that the light comes from.
fn cosine(i: &Input) -> f64 {
    -DVec3::from(i.0).dot(i.1.into())
}

fn squared(i: &Input) -> f64 {
    (i.2 - 1.0) * (i.2 + 1.0) + cosine(i) * cosine(i)
}

fn root(squared: f64) -> Option<f64> {
    (squared >= 0.0).then(|| squared.sqrt())
}

/// The direction plus so much of the normal, over η.
fn bent(i: &Input, normal: f64) -> Option<Vector> {
    Some(((DVec3::from(i.0) + normal * DVec3::from(i.1)) / i.2).into())
}

/// So many times the part along the surface, and so much against the normal.
fn parts(i: &Input, along: f64, against: f64) -> Option<Vector> {
    let normal = DVec3::from(i.1);
    Some((along * (DVec3::from(i.0) + cosine(i) * normal) - against * normal).into())
}

fn by_angle(i: &Input) -> Option<Vector> {
    let angle = libm::acos(cosine(i).min(1.0));
    let beyond = angle / i.2;
    let along = if angle > 0.0 { libm::sin(beyond) / libm::sin(angle) } else { 1.0 };
    if beyond > std::f64::consts::FRAC_PI_2 { None } else { parts(i, along, libm::cos(beyond)) }
}

fn refracted_or(i: &Input, otherwise: fn(&Input) -> DVec3) -> Option<Vector> {
    Some(refract(i.0.into(), i.1.into(), i.2).unwrap_or_else(|| otherwise(i)).into())
}

fn asked() -> Vec<Probe<Input>> {
    let up = [0.0, 1.0, 0.0];
    let anywhere = |seed, [low, high]: [f64; 2]| {
        (0..30).filter_map(move |at| {
            let mut draws = Draws::new(seed, at);
            let (normal, eta) = (draws.unit_vector().normalize(), draws.between(low, high));
            let direction = (draws.unit_vector_across(normal) * draws.between(0.0, 3.0) - normal).normalize();
            let cosine = direction.dot(normal);
            // Where a rounding decides whether light passes, nothing is asked.
            let clear = ((eta - 1.0) * (eta + 1.0) + cosine * cosine).abs() > 1e-6;
            clear.then(|| (direction.to_array(), normal.to_array(), eta))
        })
    };
    let mut asked: Vec<_> = probes("at normal incidence", [([0.0, -1.0, 0.0], up, 1.5)]).collect();
    asked.extend(probes("into glass", [([0.6, -0.8, 0.0], up, 1.5), ([0.96, -0.28, 0.0], up, 1.5)]));
    asked.extend(probes("between equals", [([0.6, -0.8, 0.0], up, 1.0)]));
    asked.extend(probes("into a medium of a higher index", anywhere(2001, [1.0, 3.0])));
    asked.extend(probes("out of glass", [([0.6, -0.8, 0.0], up, 1.0 / 1.5)]));
    asked.extend(probes(
        "out of glass, at so oblique an angle that nothing passes",
        [([0.8, -0.6, 0.0], up, 1.0 / 1.5)],
    ));
    asked.extend(probes("into a thinner medium", anywhere(2002, [0.3, 1.0])));
    asked
}

/// Below this sine of the angle to the normal a ray is hardly bent, and does not tell by which index.
const TELLS: f64 = 1e-3;

/// Directions in which light goes on into glass and out of it.
fn mine(ask: Ask<Input, Option<Vector>>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::after(
        split_stage::<SmoothGlass>,
        move |glass: Res<Shared<GlassTable>>, mut tiles: Query<(RowPlaces, &WorldRays, &Surfaces, &mut Scattered)>| {
            for (place, rays, surfaces, mut scattered) in &mut tiles {
                for ray in 0..scattered.rows() {
                    let row = scattered.row[ray] as usize;
                    let (direction, normal) = (rays.direction_of(row), surfaces.get(row).normal.as_dvec3());
                    let bent = scattered.direction(ray).as_dvec3();
                    let sine = bent.cross(normal).length();
                    if bent.dot(normal) > 0.0 || sine < TELLS {
                        continue;
                    }
                    let eta = nearest_eta(&glass.ior, direction.cross(normal).length() / sine);
                    let Some(direction) = ask.at(place, row, (direction.into(), normal.into(), eta)) else { continue };
                    match direction {
                        Some(direction) => {
                            let direction = DVec3::from(direction).as_vec3();
                            scattered.direction.put(ray, direction);
                        }
                        None => scattered.throughput.put(ray, [0.0; 3]),
                    }
                }
            }
        },
    )
}

/// The quotient of two of the scene's indices, air's 1 among them, that is nearest to a measured one.
fn nearest_eta(iors: &[f64], measured: f64) -> f64 {
    let media = || iors.iter().copied().chain([1.0]);
    let quotients = media().flat_map(|far| media().map(move |near| far / near));
    quotients.min_by(|a, b| (a - measured).abs().total_cmp(&(b - measured).abs())).unwrap_or(measured)
}

/// Angles of incidence from left to right, and from top to bottom media from half the index to twice the index.
fn painted(ask: Ask<Input, Option<Vector>>) -> StandIn {
    StandIn::painted([64, 32], move |[x, y]| {
        let (angle, eta) =
            ((f64::from(x) + 0.5) / 64.0 * std::f64::consts::FRAC_PI_2, libm::exp2(f64::from(y) / 15.5 - 1.0));
        let direction = [libm::sin(angle), 0.0, -libm::cos(angle)];
        let bent = ask.once((direction, [0.0, 0.0, 1.0], eta)).flatten();
        bent.map_or([0.0; 3], |[x, _, z]| [0.5 + 0.5 * x, 0.3, 0.5 - 0.5 * z])
    })
}
