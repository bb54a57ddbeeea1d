//! Chapter 39: the weight of one of several ways to find a path, from ratios of pdfs.

use bevy_ecs::prelude::*;
use pinhole::extract::MaterialTable;
use pinhole::follow::{self, JoinRatios, RecursiveMis};
use pinhole::intersect::Surfaces;
use pinhole::material::{MaterialKind, MatteTable, cosine_pdf};
use pinhole::plan::{Column, Shared};
use pinhole::rays::{Paths, PixelSamples, Tile, WorldRays};
use pinhole::shade::ShadowRays;
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Probe, Question, Setting, Shown, StandIn, probes};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::naive::ways::way_weight;

/// Each way's pdf over that of the way before it.
type Input = [f64; 3];

/// What the reader writes.
pub type Yours = fn([f64; 3]) -> f64;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("way_weight", question, move |&ratios| yours(ratios), mine)
        .and_in("the first two ratios from 1/8 to 8", |_| ())
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/lab/naive/ways.rs", "way_weight"),
        probes: asked(),
        tell: |ratios| format!("ratios {}", ratios.shown()),
        right: |&ratios| way_weight(ratios),
        apart: |yours, right| absolute(&[*yours], &[*right]),
        allowed: 1e-12,
        measured: "of 1",
        mistakes: mistakes(),
        hints: &[
            "the pdf of a way over that of the first is a product of ratios: p₂/p₀ = p₂/p₁ · p₁/p₀",
            "divide the sum of the four squares by the first one: it begins with 1",
            "the weight is 1 over that sum",
        ],
    }
}

fn mistakes() -> Mistakes<Input, f64> {
    Mistakes::<Input, f64>::new()
        .say("that is the balance heuristic; each pdf is squared here")
        .when(|&[a, b, c]| 1.0 / (1.0 + a * (1.0 + b * (1.0 + c))))
        .say("that is the balance heuristic squared; square each pdf, and then add")
        .when(|&[a, b, c]| 1.0 / (1.0 + a * (1.0 + b * (1.0 + c))).powi(2))
        .say(
            "the ratios are not multiplied; each is to the way before it, so that p₂/p₀ is the product of two of them",
        )
        .when(|&[a, b, c]| 1.0 / (1.0 + a * a + b * b + c * c))
        .say("the ratios are neither multiplied nor squared; p₂/p₀ is the product of two of them, and each pdf is squared")
        .when(|&[a, b, c]| 1.0 / (1.0 + a + b + c))
        .say("the first way itself is missing from the sum: its square over itself is 1")
        .when(|&[a, b, c]| 1.0 / ways(a, b, c))
        .say("only the second way is in the sum; there are four")
        .when(|&[a, _, _]| 1.0 / (1.0 + a * a))
        .say("the last way is missing from the sum")
        .when(|&[a, b, _]| 1.0 / (1.0 + a * a * (1.0 + b * b)))
        .say("only the first and the last way are in the sum")
        .when(|&[a, b, c]| 1.0 / (1.0 + (a * b * c).powi(2)))
        .say("that is the sum of squares over the first; the weight is 1 over it")
        .when(|&[a, b, c]| 1.0 + ways(a, b, c))
        .say("that is the weight of all other ways together; the first has the rest")
        .when(|&[a, b, c]| ways(a, b, c) / (1.0 + ways(a, b, c)))
        .say("the ratios are upside down: each is a way's pdf over that of the way before it")
        .when(|&[a, b, c]| 1.0 / (1.0 + ways(1.0 / a, 1.0 / b, 1.0 / c)))
        .say("only the first ratio is squared; each of them is, since each pdf is")
        .when(|&[a, b, c]| 1.0 / (1.0 + a * a * (1.0 + b * (1.0 + c))))
        .say("the sum is squared; it is the squares that are added")
        .when(|&[a, b, c]| 1.0 / (1.0 + (a * (1.0 + b * (1.0 + c))).powi(2)))
        .say("it is divided by the root of the sum of squares; the weight is 1 over the sum itself")
        .when(|&[a, b, c]| 1.0 / (1.0 + ways(a, b, c)).sqrt())
        .say("weights of pairs are multiplied; all four ways share one sum")
        .when(|&[a, b, c]| 1.0 / ((1.0 + a * a) * (1.0 + b * b) * (1.0 + c * c)))
        .say("that is the weight of the last way; asked is that of the first")
        .when(|&[a, b, c]| (a * b * c).powi(2) / (1.0 + ways(a, b, c)))
        .say("that is the weight of the second way; asked is that of the first")
        .when(|&[a, b, c]| a * a / (1.0 + ways(a, b, c)))
        .say("the likeliest way has all the weight: that is the maximum heuristic")
        .when(|&[a, b, c]| if a.max(a * b).max(a * b * c) <= 1.0 { 1.0 } else { 0.0 })
        .say("all ways have the same weight; it depends on the pdfs")
        .when(|_| 0.25)
        .say("the ratios are taken from the last to the first")
        .when(|&[a, b, c]| 1.0 / (1.0 + ways(c, b, a)))
}

/// The squares of the second, third and fourth pdf, over that of the first.
fn ways(a: f64, b: f64, c: f64) -> f64 {
    a * a * (1.0 + b * b * (1.0 + c * c))
}

fn asked() -> Vec<Probe<Input>> {
    let mut asked: Vec<_> = probes("four ways that are alike", [[1.0; 3]]).collect();
    asked.extend(probes("ways that cannot find the path", [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.5, 3.0, 0.0]]));
    asked.extend(probes("two ways", (0..8).map(|step| [0.25 * f64::from(1 << step), 0.0, 0.0])));
    let any = (0..80).map(|index| {
        let mut draws = Draws::new(3901, index);
        [(); 3].map(|()| draws.power_of_ten(-1.5, 1.5))
    });
    asked.extend(probes("any ratios", any));
    asked.extend(probes("ratios far apart", [[1e-30, 1e30, 1.0], [1e30, 1e-30, 1.0], [1e-9, 1e-9, 1e20]]));
    asked
}

/// What every shadow ray of the chapter's room asks, where all is matte: the ways on its one side, and those on the other.
fn mine(ask: Ask<Input, f64>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::instead(
        follow::join_weight_stage::<MatteTable>,
        move |materials: Res<Shared<MaterialTable>>,
              mut tiles: Query<(
            (&Tile, Option<&PixelSamples>),
            (&WorldRays, &Paths, &Surfaces, &RecursiveMis, &JoinRatios),
            &mut ShadowRays,
        )>| {
            for ((tile, samples), (eye, paths, surfaces, mis, ratios), mut rays) in &mut tiles {
                for ray in 0..rays.rows() {
                    let row = rays.row[ray] as usize;
                    if materials.kind[surfaces.material[row] as usize] != MaterialKind::Matte {
                        continue;
                    }
                    let normal = surfaces.normal(row).as_dvec3();
                    let pdf = |direction| cosine_pdf(normal.dot(direction).max(0.0));
                    let [onward, back] = [pdf(rays.direction_of(ray)), pdf(-eye.direction_of(row))];
                    let path = paths.first[row] as usize;
                    // From the camera one way more; from the light the way that ends here, and then all earlier ones.
                    let ends = ratios.reverse[ray] * mis.arrival[path];
                    let earlier = ratios.reverse[ray] * mis.earlier[path] * back * back;
                    let before = if ends > 0.0 { (earlier / ends).sqrt() } else { 0.0 };
                    let sides = [[(ratios.onward[ray]).sqrt() * onward, 0.0, 0.0], [ends.sqrt(), before, 0.0]];
                    let place = (tile, samples, Some(paths));
                    let [one, other] = sides.map(|ratios| ask.at(place, row, ratios).unwrap_or_default());
                    // Of all ways on both sides: 1/w = 1/w₁ + 1/w₂ − 1.
                    let weight = 1.0 / (1.0 / one + 1.0 / other - 1.0);
                    rays.weight_by(ray, [if weight.is_finite() { weight } else { 0.0 }; 3]);
                }
            }
        },
    )
}

/// The weight with the first ratio from left to right and the second from top to bottom, each from 1/8 to 8.
fn painted(ask: Ask<Input, f64>) -> StandIn {
    let ratio = |at: u32| libm::exp2((f64::from(at) + 0.5) * 6.0 / 64.0 - 3.0);
    StandIn::painted([64, 64], move |[x, y]| [ask.once([ratio(x), ratio(y), 1.0]).unwrap_or_default(); 3])
}
