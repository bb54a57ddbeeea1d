//! Chapter 26: the power heuristic, for pdfs of any size.

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::{AreaLightTable, EmissiveTable, NO_ROW};
use pinhole::follow;
use pinhole::follow::power_heuristic;
use pinhole::intersect::{EmissiveRows, Hits, SurfaceSides};
use pinhole::lights::Receiver;
use pinhole::plan::{Shared, VectorRowsMut};
use pinhole::rays::{Depth, Paths, PixelSamples, Tile, WorldRays};
use pinhole::shade::{Radiance, area_light_pdf};
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Probe, Question, Setting, Shown, StandIn, extremes, probes};
use pinhole_lab::measure::draws::Draws;
use std::cmp::Ordering;

type Input = (f64, f64);

/// What the reader writes.
pub type Yours = fn(f64, f64) -> f64;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("power_heuristic", question, move |&(own, other)| yours(own, other), mine)
        .and_in("pdfs from 1e-300 to 1e300", |_| ())
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/follow/emission.rs", "power_heuristic"),
        probes: asked(),
        tell: |(own, other)| format!("own {}, other {}", own.shown(), other.shown()),
        right: |&(own, other)| power_heuristic(own, other),
        apart: |yours, right| absolute(&[*yours], &[*right]),
        allowed: 1e-12,
        measured: "of 1",
        mistakes: Mistakes::<Input, f64>::new()
            .say("own² is divided by the larger of the two squares; it is over their sum")
            .when(|&(own, other)| if own == 0.0 { 0.0 } else { (own / own.max(other)).powi(2) })
            .say("f32 is computed in, which has seven digits")
            .when(|&(own, other)| {
                let [own, other] = [own as f32, other as f32];
                f64::from(own * own / (own * own + other * other))
            })
            .say("it is the difference that stands above the line; own² does")
            .when(|&(own, other)| (own - other) * (own - other) / (own * own + other * other))
            .say("that is the sum of the squares alone; it is what own² is divided by")
            .when(|&(own, other)| own * own + other * other)
            .say("1 is divided by the sum of the squares; it is own² that is")
            .when(|&(own, other)| 1.0 / (own * own + other * other))
            .say("where the other technique never samples the path, the own one has all the weight: 1")
            .when(|&(own, other)| if other == 0.0 { 0.0 } else { power_heuristic(own, other) })
            .say("that is the balance heuristic; both pdfs are squared here")
            .when(|&(own, other)| if own == 0.0 { 0.0 } else { own / (own + other) })
            .say("the two are swapped, and not squared: it is own² over the sum of both squares")
            .when(|&(own, other)| if other == 0.0 { 0.0 } else { other / (own + other) })
            .say("the two are swapped: the larger pdf has more weight")
            .when(|&(own, other)| power_heuristic(other, own))
            .when(|&(own, other)| if own == 0.0 { 0.0 } else { power_heuristic(other, own) })
            .when(|&(own, other)| other * other / (own * own + other * other))
            .say("that is the balance heuristic squared; square each pdf, and then add")
            .when(|&(own, other)| if own == 0.0 { 0.0 } else { (own / (own + other)).powi(2) })
            .when(|&(own, other)| own * own / ((own + other) * (own + other)))
            .say("it is divided by the root of the sum of squares; the weight is own² over the sum itself")
            .when(|&(own, other)| if own == 0.0 { 0.0 } else { own / own.hypot(other) })
            .when(|&(own, other)| power_heuristic(own, other) * own.hypot(other))
            .say(
                "own stands above the line unsquared, or the weight is divided by own already; it is own² over the \
                 sum of squares",
            )
            .when(|&(own, other)| if own == 0.0 { 0.0 } else { power_heuristic(own, other) / own })
            .when(|&(own, other)| own / (own * own + other * other))
            .say("the weight is multiplied by own once more; it is own² over the sum of squares")
            .when(|&(own, other)| power_heuristic(own, other) * own)
            .say("own² is divided by the sum of the pdfs; each of them is squared there, too")
            .when(|&(own, other)| if own == 0.0 { 0.0 } else { own * own / (own + other) })
            .say("own² is divided by the difference of the squares; it is their sum")
            .when(|&(own, other)| own * own / (own * own - other * other))
            .say("own² is divided by the other's alone; it is over the sum of both, from 0 to 1")
            .when(|&(own, other)| if own == 0.0 { 0.0 } else { (own / other).powi(2) })
            .say("the larger pdf has all the weight: that is the maximum heuristic")
            .when(|&(own, other)| if own > other { 1.0 } else { 0.0 })
            .when(|&(own, other)| if own >= other { 1.0 } else { 0.0 })
            .when(|&(own, other)| match own.partial_cmp(&other) {
                Some(Ordering::Greater) => 1.0,
                Some(Ordering::Equal) if own > 0.0 => 0.5,
                _ => 0.0,
            })
            .say("each pdf is cubed instead of squared")
            .when(|&(own, other)| if own == 0.0 { 0.0 } else { 1.0 / (1.0 + (other / own).powi(3)) })
            .say("the roots of the pdfs are taken instead of their squares")
            .when(|&(own, other)| if own == 0.0 { 0.0 } else { 1.0 / (1.0 + (other / own).sqrt()) })
            .say("the ratio own / other is infinite where other is 0 or tiny, and ∞ / ∞ is NaN; take other / own")
            .when(|&(own, other)| if own == 0.0 { 0.0 } else { by_own_over_other(own, other) })
            .when(|&(own, other)| by_own_over_other(own, other))
            .say(
                "squares overflow to infinity or vanish to 0, and their quotient is NaN or wrong; square only the \
                 ratio of the two",
            )
            .when(|&(own, other)| if own == 0.0 { 0.0 } else { own * own / (own * own + other * other) })
            .say(
                "squares overflow to infinity or vanish to 0, and their quotient is NaN or wrong; square only the \
                 ratio of the two, and return 0 where own is 0",
            )
            .when(|&(own, other)| own * own / (own * own + other * other))
            .say("0 is divided by 0 where neither technique samples the path; there the weight is 0")
            .when(|&(own, other)| {
                let ratio = other / own;
                1.0 / (1.0 + ratio * ratio)
            })
            .when(|&(own, other)| if own == 0.0 && other == 0.0 { f64::NAN } else { power_heuristic(own, other) })
            .say("the weight is not 0 where neither technique samples the path")
            .when(|&(own, other)| if own == 0.0 && other == 0.0 { 1.0 } else { power_heuristic(own, other) })
            .when(|&(own, other)| if own == 0.0 && other == 0.0 { 0.5 } else { power_heuristic(own, other) })
            .say("each counts half; the larger pdf has more weight")
            .when(|_| 0.5),
        hints: &[
            "with two pdfs alike the answer is 1/2, and with one three times the other 9/10",
            "divide numerator and denominator by own²: only the ratio of the two pdfs is left",
            "which of the two may be 0, and when is the ratio infinite? One of these cases needs a line of its own",
        ],
    }
}

fn by_own_over_other(own: f64, other: f64) -> f64 {
    let ratio = own / other;
    ratio * ratio / (1.0 + ratio * ratio)
}

fn asked() -> Vec<Probe<Input>> {
    let mut asked: Vec<_> = probes("pdfs alike", [(3.0, 3.0), (3.0, 1.0), (1.0, 3.0)]).collect();
    let of = |seed, count: u64, min: f64, max: f64| {
        (0..count).map(move |at| {
            let mut draws = Draws::new(seed, at);
            let own = draws.power_of_ten(min, max);
            (own, own * draws.power_of_ten(-1.5, 1.5))
        })
    };
    asked.extend(probes("ordinary pdfs", of(2601, 40, -3.0, 3.0)));
    asked.extend(probes("one that cannot sample the path", [(0.0, 2.0), (2.0, 0.0)]));
    asked.extend(extremes("pdfs too large to be squared", of(2602, 30, 160.0, 290.0)));
    asked.extend(extremes("pdfs too small to be squared", of(2603, 30, -290.0, -170.0)));
    asked.extend(extremes("one of each", [(1e200, 1e-200), (1e-200, 1e200)]));
    asked.extend(extremes("neither samples the path", [(0.0, 0.0)]));
    asked
}

/// The light of emitters that a path hits, weighted against light sampling, which could have found them too.
fn mine(ask: Ask<Input, f64>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::instead(
        follow::mis_emission_stage,
        move |(emissive, lights): (Res<Shared<EmissiveTable>>, Res<Shared<AreaLightTable>>),
              mut tiles: Query<(
            (&Tile, Option<&PixelSamples>, &Paths, &Depth),
            (&WorldRays, &Hits, &EmissiveRows, Option<&SurfaceSides>),
            &mut Radiance,
        )>| {
            for ((tile, samples, paths, depth), (rays, hits, list, sides), mut radiance) in &mut tiles {
                for (&row, &of) in list.row.iter().zip(&list.emissive) {
                    let (row, emitted) = (row as usize, emissive.radiance[of as usize]);
                    if sides.is_some_and(|sides| sides.outside[row] == 0 && emissive.one_sided[of as usize]) {
                        continue;
                    }
                    let light = lights.light_of_shape[hits.shape[row] as usize];
                    let weight = if paths.pdf[row] == f64::INFINITY || light == NO_ROW {
                        1.0
                    } else {
                        let at = rays.point_at(row, hits.t[row]);
                        // Few lights are sampled alike from all surfaces, whatever the normal.
                        let (position, normal) = (rays.origin_of(row), DVec3::ZERO);
                        let receiver = Receiver { position, normal, depth: depth.0.saturating_sub(1) };
                        let asked = (paths.pdf[row], area_light_pdf(&lights, light as usize, &receiver, at));
                        ask.at((tile, samples, Some(paths)), row, asked).unwrap_or_default()
                    } as f32;
                    radiance.rgb.add(row, emitted.map(|part| weight * part));
                }
            }
        },
    )
}

/// Pdfs from the smallest to the largest: the own one from left to right, the other from top to bottom, none in the first
/// column and line.
fn painted(ask: Ask<Input, f64>) -> StandIn {
    let pdf = |at: u32| if at == 0 { 0.0 } else { libm::exp10(10.0 * (f64::from(at) - 31.0)) };
    StandIn::painted([62, 62], move |[own, other]| [ask.once((pdf(own), pdf(other))).unwrap_or_default(); 3])
}
