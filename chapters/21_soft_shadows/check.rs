//! Chapter 21: the pdf of a direction when a point of an area is chosen uniformly.

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::{AreaLightTable, SamplingTable};
use pinhole::intersect::Surfaces;
use pinhole::lights::Receiver;
use pinhole::plan::{Shared, VectorRowsMut};
use pinhole::rays::{Depth, SampleNumber, draws_of_two};
use pinhole::sample::Purpose;
use pinhole::shade::{ShadowRays, irradiance_from_area, shadow_t_max};
use pinhole::shapes::Emitter;
use pinhole::shapes::emitter::{Parallelogram, parallelogram_area_point, pdf_from_area};
use pinhole::{rays, shade};
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Probe, Question, RowPlaces, Setting, Shown, StandIn, probes,
};
use pinhole_lab::measure::draws::Draws;

type Vector = [f64; 3];

/// The lit point, the light's point, its normal, its area.
type Input = (Vector, Vector, Vector, f64);

/// What the reader writes.
pub type Yours = fn(Vector, Vector, Vector, f64) -> f64;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered(
        "solid_angle_pdf",
        question,
        move |&(from, at, normal, area)| yours(from, at, normal, area),
        mine,
    )
    .and_in("all about a lamp", |_| ())
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/shapes/emitter/emitting.rs", "pdf_from_area"),
        probes: asked(),
        tell: |(from, at, normal, area)| {
            let [from, at, normal] = [from, at, normal].map(Shown::shown);
            format!("from {from}, at {at}, normal {normal}, area {area:?}")
        },
        right: pdf,
        apart: |yours, right| relative(&[*yours], &[*right]),
        allowed: 1e-10,
        measured: "of the pdf",
        mistakes: mistakes(),
        hints: &[
            "how much of the sky does a small part of the area fill, when it is turned to you and when it is not?",
            "a part dA at distance d fills dA cos θ / d², with θ between its normal and the direction to you; the probability \
             of the part is dA / A",
            "a pdf is a probability over what it fills: put the two together; a light seen edge-on fills nothing",
        ],
    }
}

fn mistakes() -> Mistakes<Input, f64> {
    let distance = Part::<Input, f64>::new(squared)
        .say("the distance is missing: far away the area fills less")
        .when(|_| 1.0)
        .say("the distance counts once, not squared; normal · v is d times the cosine, so divide it by d")
        .when(|i| squared(i).sqrt())
        .say("the distance is cubed; the cosine is normal · v over d, not over d²")
        .when(|i| squared(i).sqrt().powi(3))
        .say("the distance is squared twice: it is d² over A cos θ")
        .when(|i| squared(i).powi(2))
        .say("it is divided by d²; far away the same points crowd into fewer directions")
        .when(|i| 1.0 / squared(i));
    let across = Part::<Input, f64>::new(|i| cosine(i).abs())
        .say("the cosine at the light is missing: an area seen obliquely fills less")
        .when(|i| f64::from(u8::from(cosine(i) != 0.0)))
        .say(
            "the pdf is multiplied by the cosine; seen obliquely the same points crowd into fewer directions, \
                 so divide by it",
        )
        .when(|i| if cosine(i) == 0.0 { 0.0 } else { 1.0 / cosine(i).abs() })
        .say("the cosine is squared; only that at the light counts, and once")
        .when(|i| cosine(i).powi(2))
        .say("a light that faces away has a negative pdf; on which side its normal is makes no difference")
        .when(|i| -cosine(i))
        .say("the pdf is negative where the light faces you; take the cosine's absolute value")
        .when(cosine)
        .say("a light that faces away has none; on which side its normal is makes no difference here")
        .when(|i| (-cosine(i)).max(0.0))
        .say("a light that faces you has none; both of its sides shine: take the absolute value")
        .when(|i| cosine(i).max(0.0));
    let area = Part::<Input, f64>::new(|i| i.3)
        .say("the area is missing: the larger it is, the less probable is each of its points")
        .when(|_| 1.0)
        .say("the pdf is multiplied by the area; the larger it is, the less probable is each of its points")
        .when(|i| 1.0 / i.3)
        .say("it is divided by π, which belongs to cosine-weighted directions; here it is d² / (A cos θ)")
        .when(|i| i.3 * std::f64::consts::PI)
        .say("the area is taken twice; though both sides shine, the points lie on one area A")
        .when(|i| 2.0 * i.3)
        .say("the pdf is doubled; though both sides shine, the points lie on one area A")
        .when(|i| 0.5 * i.3);
    let whole = Part::<[f64; 3], f64>::new(
        |&[squared, across, area]| {
            if across == 0.0 { 0.0 } else { squared / (area * across) }
        },
    )
    .say("that is the solid angle of the area; the pdf is one over it")
    .when(|&[squared, across, area]| area * across / squared)
    .say("the conversion is upside down: of 1/A per area it makes d² / cos θ times that")
    .when(|&[squared, across, area]| across / (squared * area))
    .say("seen from its edge the area fills no direction, and the answer is to be 0, not 1 / 0")
    .when(|&[squared, across, area]| squared / (area * across));
    Mistakes::<Input, f64>::new()
        .say("that is the pdf per unit of area; of solid angle the area fills A cos θ / d²")
        .when(|i| if cosine(i) == 0.0 { 0.0 } else { 1.0 / i.3 })
        .say(
            "the pdf is multiplied by the cosine; seen obliquely the same points crowd into fewer directions, \
                 so divide by it",
        )
        .when(|i| squared(i).sqrt().powi(3) * cosine(i).abs() / i.3)
        .say("it is divided by d²; far away the same points crowd into fewer directions")
        .when(|i| if cosine(i) == 0.0 { 0.0 } else { 1.0 / (squared(i) * i.3) })
        .say("the lit point is left out: v is at − from")
        .when(|&(_, at, normal, area)| pdf(&([0.0; 3], at, normal, area)))
        .of_parts([distance, across, area], whole)
}

fn asked() -> Vec<Probe<Input>> {
    let anywhere = |seed, low: f64, high: f64| {
        (0..40).map(move |at| {
            let mut draws = Draws::new(seed, at);
            let (to_light, normal) = (draws.unit_vector(), draws.unit_vector());
            let from = draws.unit_vector();
            let there = from + to_light * draws.power_of_ten(low, high);
            (from.to_array(), there.to_array(), normal.to_array(), draws.power_of_ten(-2.0, 2.0))
        })
    };
    let (down, origin) = ([0.0, -1.0, 0.0], [0.0; 3]);
    let mut asked: Vec<_> =
        probes("a square of area 1 straight above", [(origin, [0.0, 1.0, 0.0], down, 1.0)]).collect();
    asked.extend(probes("the same at other distances", [2.0, 10.0].map(|y| (origin, [0.0, y, 0.0], down, 1.0))));
    asked.extend(probes("a larger one", [(origin, [0.0, 2.0, 0.0], down, 6.0)]));
    asked.extend(probes("obliquely", [(origin, [3.0, 4.0, 0.0], down, 1.0), ([1.0; 3], [1.0, 4.0, 5.0], down, 2.0)]));
    asked.extend(probes("its back", [(origin, [3.0, 4.0, 0.0], [0.0, 1.0, 0.0], 1.0)]));
    asked.extend(probes("anywhere", anywhere(2107, -1.0, 2.0)));
    asked.extend(probes(
        "from its edge",
        [(origin, [2.0, 0.0, 0.0], down, 1.0), ([5.0, 1.0, 0.0], [5.0, 1.0, -7.0], down, 3.0)],
    ));
    asked.extend(probes("about 1e8 away", anywhere(2108, 7.5, 8.5)));
    asked.extend(probes("about 1e-6 away", anywhere(2109, -6.5, -5.5)));
    asked
}

fn to_light(&(from, at, ..): &Input) -> DVec3 {
    DVec3::from(at) - DVec3::from(from)
}

fn squared(input: &Input) -> f64 {
    to_light(input).length_squared()
}

/// Between the light's normal and the direction to it: below 0 where its front is seen.
fn cosine(input: &Input) -> f64 {
    DVec3::from(input.2).dot(to_light(input)) / squared(input).sqrt()
}

fn pdf(input: &Input) -> f64 {
    pdf_from_area(to_light(input), DVec3::from(input.2), input.3)
}

/// Shadow rays to rectangles by points chosen evenly over their area, with the pdf that the reader's function gives.
///
/// Pinhole itself samples a rectangle that is near by its solid angle: the mean is the same, the noise is less.
fn mine(ask: Ask<Input, f64>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::after(
        shade::area_light_stage,
        move |(lights, sampling): (Res<Shared<AreaLightTable>>, Res<Shared<SamplingTable>>),
              mut points: Local<Vec<[f64; 2]>>,
              mut tiles: Query<(RowPlaces, Option<&SampleNumber>, Option<&Depth>, &Surfaces, &mut ShadowRays)>| {
            for (place, number, depth, surfaces, mut rays) in &mut tiles {
                let ((tile, samples, paths), depth) = (place, depth.copied().unwrap_or_default());
                let draws = rays::Draws { sampling: &sampling, tile, number, samples, paths, depth };
                draws_of_two(&draws, Purpose::LightPoint, &rays.row, &mut points);
                for (ray, &u) in points.iter().enumerate() {
                    let row = rays.row[ray] as usize;
                    let from = rays.origin(ray).as_dvec3();
                    let direction = rays.direction_of(ray);
                    let rectangles = lights.emitter.iter().enumerate().filter_map(rectangle);
                    let Some((light, shape)) = rectangles.into_iter().find(|(_, shape)| seen(shape, from, direction))
                    else {
                        continue;
                    };
                    let to = parallelogram_area_point(shape, from, u).to;
                    let asked = (from.into(), (from + to).into(), shape.normal.into(), shape.area());
                    let Some(pdf) = ask.at(place, row, asked) else { continue };
                    let cosine = surfaces.get(row).normal.as_dvec3().dot(to.normalize()).max(0.0);
                    let receiver = Receiver { depth: depth.0, ..Receiver::default() };
                    let pdf = lights.probability_of(light, &receiver) * pdf;
                    let light = irradiance_from_area(lights.radiance[light], cosine, pdf).map(|part| part as f32);
                    let finite = light.iter().all(|part| part.is_finite());
                    rays.irradiance.put(ray, if finite { light } else { [0.0; 3] });
                    rays.direction.put(ray, to.normalize().as_vec3());
                    rays.t_max[ray] = shadow_t_max(to.length());
                }
            }
        },
    )
}

fn rectangle((light, emitter): (usize, &Emitter)) -> Option<(usize, &Parallelogram)> {
    if let Emitter::Rectangle(shape) = emitter { Some((light, shape)) } else { None }
}

/// Whether a direction leads to the rectangle.
fn seen(shape: &Parallelogram, from: DVec3, direction: DVec3) -> bool {
    let t = shape.normal.dot(shape.centre - from) / shape.normal.dot(direction);
    let off = from + t * direction - shape.centre;
    // A direction has f32 numbers, so the light's edge is not exact.
    t > 0.0 && shape.half_edges.iter().all(|half| off.dot(*half).abs() <= 1.0001 * half.length_squared())
}

/// Every place about a small lamp that shines upward: the brighter, the less likely is its point.
fn painted(ask: Ask<Input, f64>) -> StandIn {
    StandIn::painted([64, 32], move |[x, y]| {
        let from = [(f64::from(x) - 31.5) / 8.0, 0.0, (15.5 - f64::from(y)) / 8.0];
        let pdf = ask.once((from, [0.0; 3], [0.0, 0.0, 1.0], 1.0)).unwrap_or_default();
        [1.0 / (1.0 + pdf); 3]
    })
}
