//! Chapter 10: the radiance that a matte surface reflects of a point light.

use super::mine::mine;
use glam::DVec3;
use pinhole::{lights, shade};
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;
use std::f64::consts::PI;

type Vector = [f64; 3];
/// Colour, intensity, position, normal, light.
pub(super) type Input = (f64, f64, Vector, Vector, Vector);

/// What the reader writes.
pub type Yours = fn(f64, f64, Vector, Vector, Vector) -> f64;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::reflected_radiance)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered(
        "reflected_radiance",
        question,
        move |&(c, i, position, normal, light)| yours(c, i, position, normal, light),
        mine,
    )
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/lights/irradiance.rs", "irradiance_from_point"),
        probes: asked(),
        tell: |(colour, intensity, position, normal, light)| {
            let [position, normal, light] = [position, normal, light].map(Shown::shown);
            format!("colour {colour:?}, intensity {intensity:?}, position {position}, normal {normal}, light {light}")
        },
        right: |input| radiance(input, cosine(input)),
        apart: |yours, right| relative(&[*yours], &[*right]),
        allowed: 1e-10,
        measured: "of the radiance",
        mistakes: vec![
            Mistake::new("a surface that faces away sends on a negative light; it gets none", |input| {
                sent(input, cosine(input), distance(input) * distance(input))
            }),
            Mistake::new("a surface that faces away is lit from behind: the cosine lost its sign", |input| {
                sent(input, cosine(input).abs(), distance(input) * distance(input))
            }),
            Mistake::new(
                "where the light is at the very point, 0 / 0 is NaN: no direction leads to it, so no light",
                |i| {
                    if distance(i) == 0.0 { f64::NAN } else { radiance(i, cosine(i)) }
                },
            ),
            Mistake::new(
                "the light thins out with the distance once, not twice: either it is not squared, or the vector to the light was \
             not of length 1 when its cosine was taken",
                |input| sent(input, cosine(input).max(0.0), distance(input)),
            ),
            Mistake::new("the light does not thin out with the distance", |input| {
                sent(input, cosine(input).max(0.0), 1.0)
            }),
            Mistake::new("the BRDF is colour / π; the π is missing", |input| PI * radiance(input, cosine(input))),
            Mistake::new("the cosine is missing: oblique light spreads over a larger area", |input| {
                if cosine(input) > 0.0 { radiance(input, 1.0) } else { 0.0 }
            }),
            Mistake::new("the direction leads from the light to the surface; the opposite is meant", |input| {
                radiance(input, -cosine(input))
            }),
            Mistake::new("the distance is measured from the origin; it is that from position to light", |input| {
                sent(input, cosine(input).max(0.0), DVec3::from(input.4).length_squared())
            }),
        ],
        hints: &[
            "three factors: what the surface sends on, colour / π; how obliquely the light falls; how far it came",
            "with v = light − position and d its length the cosine is normal · v / d, and the light thins out with d²",
            "colour / π · intensity · cosine / d² where the cosine is above 0; 0 where it is not, and where d is 0",
        ],
    }
}

fn asked() -> Vec<Probe<Input>> {
    let up = [0.0, 1.0, 0.0];
    let lit_from = |position, light| (0.8, 50.0, position, up, light);
    let anywhere = |seed, low: f64, high: f64| {
        (0..40).map(move |at| {
            let mut draws = Draws::new(seed, at);
            let (colour, intensity) = (draws.unit(), draws.power_of_ten(-2.0, 4.0));
            let normal = draws.unit_vector();
            let facing = if at % 4 == 3 { -1.0 } else { 1.0 };
            let towards = normal * facing + draws.unit_vector_across(normal) * draws.between(0.0, 2.0);
            let to_light = towards.normalize() * draws.power_of_ten(low, high);
            let position = draws.unit_vector() * to_light.length() * draws.unit();
            (colour, intensity, position.to_array(), normal.to_array(), (position + to_light).to_array())
        })
    };
    let mut asked: Vec<_> = probes("a light straight above", [lit_from([0.0; 3], [0.0, 2.0, 0.0])]).collect();
    asked.extend(probes("a light straight above, elsewhere", [lit_from([3.0, 1.0, -2.0], [3.0, 5.0, -2.0])]));
    asked.extend(probes(
        "a light at an oblique angle",
        [lit_from([0.0; 3], [3.0, 4.0, 0.0]), lit_from([1.0; 3], [1.0, 4.0, 5.0])],
    ));
    asked.extend(probes(
        "a light behind the surface",
        [lit_from([0.0; 3], [0.0, -2.0, 0.0]), lit_from([0.0; 3], [3.0, -4.0, 0.0])],
    ));
    asked.extend(probes("a light anywhere", anywhere(1001, -1.0, 2.0)));
    asked.extend(probes(
        "a light in the surface",
        [lit_from([0.0; 3], [2.0, 0.0, 0.0]), lit_from([5.0, 1.0, 0.0], [5.0, 1.0, -7.0])],
    ));
    asked.extend(probes(
        "a light at the very point",
        [lit_from([0.0; 3], [0.0; 3]), lit_from([0.1, 0.2, 0.3], [0.1, 0.2, 0.3])],
    ));
    asked.extend(probes("a black surface", [(0.0, 50.0, [0.0; 3], up, [0.0, 2.0, 0.0])]));
    asked.extend(probes("a light about 1e8 away", anywhere(1002, 7.5, 8.5)));
    asked.extend(probes("a light about 1e-8 away", anywhere(1003, -8.5, -7.5)));
    asked
}

fn to_light(&(_, _, position, _, light): &Input) -> DVec3 {
    DVec3::from(light) - DVec3::from(position)
}

fn distance(input: &Input) -> f64 {
    to_light(input).length()
}

/// NaN where the light is at the very point.
fn cosine(input: &Input) -> f64 {
    DVec3::from(input.3).dot(to_light(input)) / distance(input)
}

/// Pinhole's radiance where the cosine is above 0, and else none.
fn radiance(input: &Input, cosine: f64) -> f64 {
    if cosine > 0.0 { sent(input, cosine, to_light(input).length_squared()) } else { 0.0 }
}

fn sent(&(colour, intensity, ..): &Input, cosine: f64, distance_squared: f64) -> f64 {
    let irradiance = lights::irradiance_from_point([intensity; 3], cosine, distance_squared);
    shade::matte_radiance([colour; 3], irradiance)[0]
}
