//! Chapter 10: the radiance that a matte surface reflects of a point light.

use super::mine::mine;
use glam::DVec3;
use pinhole::lights;
use pinhole::material::lambertian;
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;
use std::f64::consts::PI;

type Vector = [f64; 3];
/// Colour, intensity, position, normal, light.
pub(super) type Input = (f64, f64, Vector, Vector, Vector);

/// What the reader writes.
pub type Yours = fn(f64, f64, Vector, Vector, Vector) -> f64;

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
        right,
        apart: |yours, right| relative(&[*yours], &[*right]),
        allowed: 1e-10,
        measured: "of the radiance",
        mistakes: vec![
            Mistake::new("a surface that faces away sends on a negative light; it gets none", |i| {
                faded(i, cosine(i), 2)
            }),
            Mistake::new("a surface that faces away sends on a negative light; it gets none", |i| {
                if distance(i) == 0.0 { 0.0 } else { faded(i, cosine(i), 2) }
            }),
            Mistake::new("a surface that faces away is lit from behind: the cosine lost its sign", |i| {
                faded(i, cosine(i).abs(), 2)
            }),
            Mistake::new("a surface that faces away is lit from behind: the cosine lost its sign", |i| {
                if distance(i) == 0.0 { 0.0 } else { faded(i, cosine(i).abs(), 2) }
            }),
            Mistake::new(
                "where the light is at the very point, 0 / 0 is NaN: no direction leads to it, so no light",
                |i| if distance(i) == 0.0 { f64::NAN } else { radiance(i, cosine(i)) },
            ),
            Mistake::new(
                "where the light is at the very point, its distance of 0 is divided by: no direction leads to it, so \
                 no light",
                |i| if distance(i) == 0.0 { f64::INFINITY } else { radiance(i, cosine(i)) },
            ),
            Mistake::new(CLOSE, |i| if distance(i) < 1e-3 { 0.0 } else { right(i) }),
            Mistake::new(CLOSE, |i| radiance(i, cosine(i)) * f64::from(u8::from(to_light(i).length_squared() > 1e-12))),
            Mistake::new(
                "the light thins out with the distance once, not twice: either it is not squared, or the vector to the light was \
                 not of length 1 when its cosine was taken",
                |i| faded(i, lit(i), 1),
            ),
            Mistake::new("the light does not thin out with the distance", |i| faded(i, lit(i), 0)),
            Mistake::new(
                "the light does not thin out, and the vector to it was not of length 1 when its cosine was taken",
                |i| faded(i, lit(i), -1),
            ),
            Mistake::new(TOO_MUCH, |i| faded(i, lit(i), 3)),
            Mistake::new(TOO_MUCH, |i| faded(i, lit(i), 4)),
            Mistake::new("the BRDF is colour / π; the π is missing", |i| PI * right(i)),
            Mistake::new("the BRDF is colour / π; it is not multiplied by π", |i| PI * PI * right(i)),
            Mistake::new(
                "the BRDF is colour / π, not colour / 2π: the cosine halves what the hemisphere's 2π gives",
                |i| right(i) / 2.0,
            ),
            Mistake::new(SPHERE, |i| right(i) / (4.0 * PI)),
            Mistake::new(SPHERE, |i| right(i) / 4.0),
            Mistake::new("the intensity is divided by π as well; only the colour is", |i| right(i) / PI),
            Mistake::new("the cosine is missing: oblique light spreads over a larger area", |i| {
                if cosine(i) > 0.0 { faded(i, 1.0, 2) } else { 0.0 }
            }),
            Mistake::new("the cosine is missing: oblique light spreads over a larger area", |i| faded(i, 1.0, 2)),
            Mistake::new("the cosine is squared; the light spreads over a larger area once", |i| {
                faded(i, lit(i) * lit(i), 2)
            }),
            Mistake::new("the angle itself is taken, not its cosine", |i| faded(i, libm::acos(cosine(i)).max(0.0), 2)),
            Mistake::new("the sine is taken; light straight from above falls fully", |i| {
                if cosine(i) > 0.0 { faded(i, (1.0 - cosine(i) * cosine(i)).sqrt(), 2) } else { 0.0 }
            }),
            Mistake::new(TURNED, |i| radiance(i, -cosine(i))),
            Mistake::new(TURNED, |i| faded(i, (-cosine(i)).max(0.0), 2)),
            Mistake::new(TURNED, |i| faded(i, -cosine(i), 2)),
            Mistake::new("the distance is measured from the origin; it is that from position to light", |i| {
                sent(i, lit(i), DVec3::from(i.4).length_squared())
            }),
            Mistake::new("the position is left out: the light is seen from there, not from the origin", |i| {
                right(&(i.0, i.1, [0.0; 3], i.3, i.4))
            }),
            Mistake::new("the position is added; the vector to the light is light − position", |i| {
                right(&(i.0, i.1, i.2.map(|part| -part), i.3, i.4))
            }),
            Mistake::new("the colour is left out", |i| right(&(1.0, i.1, i.2, i.3, i.4))),
            Mistake::new("the intensity is left out", |i| right(&(i.0, 1.0, i.2, i.3, i.4))),
            Mistake::new("this is what arrives, the irradiance; the surface sends colour / π of it on", |i| {
                PI * right(&(1.0, i.1, i.2, i.3, i.4))
            }),
            Mistake::new("the cosine is taken at the origin; the direction to the light is light − position", |i| {
                let light = DVec3::from(i.4);
                radiance(i, DVec3::from(i.3).dot(light) / light.length())
            }),
            Mistake::new("the answer is cut off at 1; radiance may be as large as it likes", |i| right(i).min(1.0)),
            Mistake::new("the normal is not asked where it points: only its y counts, as if it pointed up", |i| {
                radiance(i, to_light(i).y / distance(i))
            }),
            Mistake::new("the cosine is halved and has 1/2 added, which lights what faces away", |i| {
                faded(i, 0.5 * cosine(i) + 0.5, 2)
            }),
            Mistake::new("1 is added to d²; the light thins out with the distance squared alone", |i| {
                sent(i, lit(i), 1.0 + to_light(i).length_squared())
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
    lambertian([colour; 3])[0] * irradiance[0]
}

const TURNED: &str = "the direction leads from the light to the surface; the opposite is meant";
const CLOSE: &str = "a light close by counts as one at the very point; only a distance of 0 does";
const TOO_MUCH: &str = "the light thins out too fast: a distance is divided by once too often, beside the d² there is \
                        only the d of the \
                        cosine";
const SPHERE: &str = "the intensity is divided by 4π; it is what the light sends into each steradian already";

fn right(input: &Input) -> f64 {
    radiance(input, cosine(input))
}

fn lit(input: &Input) -> f64 {
    cosine(input).max(0.0)
}

/// Thinned out with this power of the distance.
fn faded(input: &Input, cosine: f64, power: i32) -> f64 {
    sent(input, cosine, distance(input).powi(power))
}
