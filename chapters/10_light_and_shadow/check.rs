//! Chapter 10: the radiance that a matte surface reflects of a point light.

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::{MaterialTable, PointLightTable};
use pinhole::follow::direct_light_stage;
use pinhole::intersect::{NO_SHAPE, Surfaces};
use pinhole::lights;
use pinhole::lights::PlacedPointLight;
use pinhole::material::{MatteTable, lambertian};
use pinhole::plan::{Column, Shared, VectorRowsMut};
use pinhole::shade::{Radiance, ShadowHits, ShadowRays};
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Probe, Question, RowPlaces, Setting, Shown, StandIn, probes,
};
use pinhole_lab::measure::draws::Draws;
use std::f64::consts::PI;

type Vector = [f64; 3];

/// Colour, intensity, position, normal, light.
type Input = (f64, f64, Vector, Vector, Vector);

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
    .and_in("next to a lamp", |_| ())
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/lights/light.rs", "irradiance_from_point"),
        probes: asked(),
        tell: |(colour, intensity, position, normal, light)| {
            let [position, normal, light] = [position, normal, light].map(Shown::shown);
            format!("colour {colour:?}, intensity {intensity:?}, position {position}, normal {normal}, light {light}")
        },
        right,
        apart: |yours, right| relative(&[*yours], &[*right]),
        allowed: 1e-10,
        measured: "of the radiance",
        mistakes: mistakes(),
        hints: &[
            "three factors: what the surface sends on, colour / π; how obliquely the light falls; how far it came",
            "with v = light − position and d its length the cosine is normal · v / d, and the light thins out with d²",
            "multiply what you have; then ask what a light behind the surface gives, and one at the very point",
        ],
    }
}

fn mistakes() -> Mistakes<Input, f64> {
    let brdf = Part::<Input, f64>::new(|i| i.0 / PI)
        .say("the BRDF is colour / π; the π is missing")
        .when(|i| i.0)
        .say("the BRDF is colour / π; it is not multiplied by π")
        .when(|i| i.0 * PI)
        .say("the BRDF is colour / π, not colour / 2π: the cosine halves what the hemisphere's 2π gives")
        .when(|i| i.0 / (2.0 * PI))
        .say("the colour is left out")
        .when(|_| 1.0 / PI)
        .say("this is what arrives, the irradiance; the surface sends colour / π of it on")
        .when(|_| 1.0);
    let intensity = Part::<Input, f64>::new(|i| i.1)
        .say("the intensity is divided by 4π; it is what the light sends into each steradian already")
        .when(|i| i.1 / (4.0 * PI))
        .when(|i| i.1 / 4.0)
        .say("the intensity is divided by π as well; only the colour is")
        .when(|i| i.1 / PI)
        .say("the intensity is left out")
        .when(|_| 1.0);
    let falls = Part::<Input, f64>::new(lit)
        .say("a surface that faces away sends on a negative light; it gets none")
        .when(cosine)
        .when(|i| if distance(i) == 0.0 { 0.0 } else { cosine(i) })
        .say("a surface that faces away is lit from behind: the cosine lost its sign")
        .when(|i| cosine(i).abs())
        .when(|i| if distance(i) == 0.0 { 0.0 } else { cosine(i).abs() })
        .say("where the light is at the very point, 0 / 0 is NaN: no direction leads to it, so no light")
        .when(|i| if distance(i) == 0.0 { f64::NAN } else { lit(i) })
        .say("a light close by counts as one at the very point; only a distance of 0 does")
        .when(|i| if distance(i) < 1e-3 { 0.0 } else { lit(i) })
        .when(|i| if distance(i) < 1e-6 { 0.0 } else { lit(i) })
        .say("the cosine is missing: oblique light spreads over a larger area")
        .when(|i| f64::from(u8::from(cosine(i) > 0.0)))
        .when(|_| 1.0)
        .say("the cosine is squared; the light spreads over a larger area once")
        .when(|i| lit(i) * lit(i))
        .say("the angle itself is taken, not its cosine")
        .when(|i| libm::acos(cosine(i)).max(0.0))
        .say("the sine is taken; light straight from above falls fully")
        .when(|i| if cosine(i) > 0.0 { (1.0 - cosine(i) * cosine(i)).sqrt() } else { 0.0 })
        .say("the direction leads from the light to the surface; the opposite is meant")
        .when(|i| (-cosine(i)).max(0.0))
        .when(|i| -cosine(i))
        .say("the cosine is taken at the origin; the direction to the light is light − position")
        .when(|i| (DVec3::from(i.3).dot(i.4.into()) / DVec3::from(i.4).length()).max(0.0))
        .say("the normal is not asked where it points: only its y counts, as if it pointed up")
        .when(|i| (to_light(i).y / distance(i)).max(0.0))
        .say("the cosine is halved and has 1/2 added, which lights what faces away")
        .when(|i| 0.5 * cosine(i) + 0.5);
    let thinned = Part::<Input, f64>::new(|i| distance(i).powi(2))
        .say(
            "the light thins out with the distance once, not twice: either it is not squared, or the vector to \
                 the light was not of length 1 when its cosine was taken",
        )
        .when(distance)
        .say("the light does not thin out with the distance")
        .when(|_| 1.0)
        .say("the light does not thin out, and the vector to it was not of length 1 when its cosine was taken")
        .when(|i| 1.0 / distance(i))
        .say(
            "the light thins out too fast: a distance is divided by once too often, beside the d² there is \
                 only the d of the cosine",
        )
        .when(|i| distance(i).powi(3))
        .when(|i| distance(i).powi(4))
        .say("the distance is measured from the origin; it is that from position to light")
        .when(|i| DVec3::from(i.4).length_squared())
        .say("1 is added to d²; the light thins out with the distance squared alone")
        .when(|i| 1.0 + distance(i).powi(2));
    let whole = Part::<[f64; 4], f64>::new(
        |&[brdf, intensity, falls, thinned]| {
            if falls == 0.0 { 0.0 } else { brdf * intensity * falls / thinned }
        },
    );
    Mistakes::<Input, f64>::new()
        .say("a gamma is applied; radiance is linear, and only the picture's file has a gamma")
        .when(|i| libm::pow(right(i), 1.0 / 2.2))
        .say("|x| + |y| + |z| is taken for the distance; it is √(x² + y² + z²)")
        .when(|&(colour, intensity, position, normal, light)| {
            let to_light = DVec3::from(light) - DVec3::from(position);
            let d = to_light.abs().element_sum();
            colour / std::f64::consts::PI * intensity * (DVec3::from(normal).dot(to_light) / d).max(0.0) / (d * d)
        })
        .say(
            "where the light is at the very point, its distance of 0 is divided by: no direction leads to it, \
                 so no light",
        )
        .when(|i| if distance(i) == 0.0 { f64::INFINITY } else { right(i) })
        .say("the position is left out: the light is seen from there, not from the origin")
        .when(|i| right(&(i.0, i.1, [0.0; 3], i.3, i.4)))
        .say("the position is added; the vector to the light is light − position")
        .when(|i| right(&(i.0, i.1, i.2.map(|part| -part), i.3, i.4)))
        .say("the answer is cut off at 1; radiance may be as large as it likes")
        .when(|i| right(i).min(1.0))
        .of_parts([brdf, intensity, falls, thinned], whole)
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

fn right(input: &Input) -> f64 {
    radiance(input, cosine(input))
}

fn lit(input: &Input) -> f64 {
    cosine(input).max(0.0)
}

/// Radiance of matte surfaces from the point lights that nothing hides from them.
fn mine(ask: Ask<Input, f64>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::instead(
        direct_light_stage::<MatteTable>,
        move |materials: Res<Shared<MaterialTable>>,
              lights: Res<Shared<PointLightTable>>,
              mut tiles: Query<(RowPlaces, &Surfaces, &ShadowRays, Option<&ShadowHits>, &mut Radiance)>| {
            for (place, surfaces, rays, shadows, mut radiance) in &mut tiles {
                for ray in (0..rays.rows()).filter(|&ray| shadows.is_none_or(|hits| hits.shape[ray] == NO_SHAPE)) {
                    let row = rays.row[ray] as usize;
                    let surface = surfaces.get(row);
                    let (position, normal) = (surface.position.as_dvec3(), surface.normal.as_dvec3());
                    let Some(light) = in_direction(&lights.row, position, rays.direction_of(ray)) else {
                        continue;
                    };
                    let colour = materials.parameters[surface.material as usize].colour;
                    let light_of = |part: usize| {
                        let (intensity, light) = (lights.row[light].intensity[part], lights.row[light].position.into());
                        let asked = (colour[part], intensity, position.into(), normal.into(), light);
                        ask.at(place, row, asked).unwrap_or_default() as f32
                    };
                    radiance.rgb.add(row, [light_of(0), light_of(1), light_of(2)]);
                }
            }
        },
    )
}

/// The light that a direction leads to.
fn in_direction(lights: &[PlacedPointLight], from: DVec3, direction: DVec3) -> Option<usize> {
    let along = |light: &PlacedPointLight| (light.position - from).normalize_or_zero().dot(direction);
    (0..lights.len()).max_by(|&a, &b| along(&lights[a]).total_cmp(&along(&lights[b])))
}

/// A speck within a hair's breadth of a light, which faces it on the left and faces away on the right.
fn painted(ask: Ask<Input, f64>) -> StandIn {
    StandIn::painted([48, 24], move |[x, y]| {
        let position = [1e-5 * (f64::from(x % 24) - 11.5), 0.0, 1e-5 * (f64::from(y) - 11.5)];
        let normal = [0.0, if x < 24 { 1.0 } else { -1.0 }, 0.0];
        [ask.once((1.0, 7e-9, position, normal, [0.0, 5e-5, 0.0])).unwrap_or_default(); 3]
    })
}
