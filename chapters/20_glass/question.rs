//! Chapter 20: a direction through a surface of glass, where there is one.

use super::mine::mine;
use glam::DVec3;
use pinhole::material::refract;
use pinhole_lab::exercise::apart::{absolute, option};
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;

pub(super) type Vector = [f64; 3];
/// A direction, a normal, and the far side's index of refraction over the near side's.
pub(super) type Input = (Vector, Vector, f64);

/// What the reader writes.
pub type Yours = fn(Vector, Vector, f64) -> Option<Vector>;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::refracted)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("refracted", question, move |&(direction, normal, eta)| yours(direction, normal, eta), mine)
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
        mistakes: vec![
            Mistake::new("the root of a negative number is NaN: ask before you take it, and answer None", |i| {
                let (d, n) = (DVec3::from(i.0), DVec3::from(i.1));
                let cosine = -d.dot(n);
                let root = (i.2 * i.2 - 1.0 + cosine * cosine).sqrt();
                Some(((d + (cosine - root) * n) / i.2).into())
            }),
            Mistake::new("η is inverted: it is the far side's index over the near side's", |i| {
                refract(i.0.into(), i.1.into(), 1.0 / i.2).map(Into::into)
            }),
            Mistake::new(
                "what comes out goes back to the near side: the normal's part must point into the surface",
                |i| {
                    let (bent, n) = (refract(i.0.into(), i.1.into(), i.2)?, DVec3::from(i.1));
                    Some((bent - 2.0 * bent.dot(n) * n).into())
                },
            ),
            Mistake::new(
                "only the part along the surface is divided by η; the other follows from the length of 1",
                |i| {
                    let (d, n) = (DVec3::from(i.0), DVec3::from(i.1));
                    let along = d.dot(n) * n;
                    Some(((d - along) / i.2 + along).into())
                },
            ),
            Mistake::new("the direction goes straight on", |i| Some(i.0)),
        ],
        hints: &[
            "split the direction into a part along the surface, d + (−d · n) n, and a part along the normal",
            "by Snell's law the part along the surface is divided by η; the other is √(1 − its square), against the \
             normal; where that is NaN, no light passes",
            "with c = −d · n and g² = η² − 1 + c²: None where g² < 0, else (d + (c − g) n) / η",
        ],
    }
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
