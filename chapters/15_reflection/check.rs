//! Chapter 15: what a Phong surface sends on of parallel light.

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::{MaterialKind, MaterialTable};
use pinhole::follow::direct_light_stage;
use pinhole::intersect::{NO_SHAPE, Surfaces};
use pinhole::material::{PhongTable, half_vector_cosine, highlight, lambertian, mirror_cosine, phong_peak};
use pinhole::plan::{Column, Shared, VectorRowsMut};
use pinhole::rays::WorldRays;
use pinhole::shade::{Radiance, ShadowHits, ShadowRays};
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Probe, Question, RowPlaces, Setting, Shown, StandIn, extremes, probes,
};
use pinhole_lab::measure::draws::Draws;
use std::f64::consts::PI;

type Vector = [f64; 3];

/// Colour, specular and exponent; irradiance, normal, the directions to the light and to the eye.
type Input = (Vector, f64, Vector, Vector, Vector);

/// What the reader writes.
pub type Yours = fn(Vector, f64, Vector, Vector, Vector) -> f64;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered(
        "phong_radiance",
        question,
        move |&(m, e, normal, light, eye)| yours(m, e, normal, light, eye),
        mine,
    )
    .and_in("a wide highlight", |_| ())
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/material/phong.rs", "mirror_cosine"),
        probes: asked(),
        tell: |([colour, specular, exponent], irradiance, normal, to_light, to_eye)| {
            let [normal, to_light, to_eye] = [normal, to_light, to_eye].map(Shown::shown);
            let material = format!("colour {colour:?}, specular {specular:?}, exponent {exponent:?}");
            format!("{material}, irradiance {irradiance:?}, normal {normal}, to_light {to_light}, to_eye {to_eye}")
        },
        right,
        apart: |yours, right| relative(&[*yours], &[*right]),
        allowed: 1e-10,
        measured: "of the radiance",
        mistakes: mistakes(),
        hints: &[
            "two parts, matte and highlight, each times what arrives: the irradiance times the cosine of the light's \
             angle",
            "the highlight is specular · (n + 2) / 2π · cosⁿα, with cos α = (2(n·l)n − l) · v, and none where cos α \
             is below 0",
            "add the two parts before you multiply by what arrives; and what is left of a light below the surface?",
        ],
    }
}

fn mistakes() -> Mistakes<Input, f64> {
    let matte = Part::<Input, f64>::new(|i| diffuse(i, lit(i)))
        .say("the cosine is forgotten in the matte part; it lessens what arrives, so it counts for both")
        .when(|i| if cosine(i) > 0.0 { diffuse(i, 1.0) } else { 0.0 })
        .say("the matte part is colour / π; the π is missing")
        .when(|i| diffuse(i, lit(i)) * PI)
        .say("the matte part is colour / π, not colour / 2π")
        .when(|i| diffuse(i, lit(i)) / 2.0)
        .say("the matte part is left out")
        .when(|_| 0.0)
        .say(LESSENED)
        .when(|i| diffuse(i, lit(i)) * (1.0 - i.0[1]))
        .when(|i| diffuse(i, lit(i)) * (1.0 - i.0[1] / i.0[0]))
        .say("the matte part is left out where there is no highlight; it has nothing to do with the eye")
        .when(|i| if alpha(i) > 0.0 { diffuse(i, lit(i)) } else { 0.0 })
        .say("the matte part has the factor of the highlight, too; it is colour / π")
        .when(|i| diffuse(i, lit(i)) * phong_peak(i.0[2]) * PI)
        .say("the colour is left out of the matte part")
        .when(|i| diffuse(i, lit(i)) / i.0[0])
        .say(FACES_AWAY)
        .when(|i| diffuse(i, cosine(i)))
        .when(|i| diffuse(i, cosine(i).abs()));
    let shiny = Part::<Input, f64>::new(specular)
        .say("the cosine is forgotten in the highlight; it lessens what arrives, so it counts for both")
        .when(|i| if cosine(i) > 0.0 { peak(i, lobe(i, alpha(i)), 1.0) } else { 0.0 })
        .when(|i| peak(i, lobe(i, alpha(i)), 1.0))
        .say("the irradiance is left out of the highlight; it sends on what arrives, too")
        .when(|i| specular(i) / i.1)
        .say("the irradiance and the cosine are left out of the highlight; it sends on what arrives, too")
        .when(|i| if cosine(i) > 0.0 { peak(i, lobe(i, alpha(i)), 1.0 / i.1) } else { 0.0 })
        .say("the factor (n + 2) / 2π of the highlight is missing")
        .when(|i| specular(i) / phong_peak(i.0[2]))
        .say("the highlight lacks its factor (n + 2) / 2π and the cosine of the light's angle")
        .when(|i| if cosine(i) > 0.0 { peak(i, lobe(i, alpha(i)) / phong_peak(i.0[2]), 1.0) } else { 0.0 })
        .say("the factor is that of cosⁿ alone, (n + 1) / 2π; the eye's own cosine makes it n + 2")
        .when(|i| specular(i) * (i.0[2] + 1.0) / (i.0[2] + 2.0))
        .say("the factor of the highlight is another one; it is (n + 2) / 2π, all of 2π below the line")
        .when(|i| specular(i) * 2.0)
        .when(|i| specular(i) * PI * PI)
        .when(|i| specular(i) * 0.5)
        .when(|i| specular(i) * 2.0 * PI)
        .when(|i| specular(i) * PI)
        .when(|i| specular(i) / PI)
        .when(|i| specular(i) * 2.0 / (i.0[2] + 2.0))
        .when(|i| specular(i) * i.0[2] / (i.0[2] + 2.0))
        .when(|i| specular(i) * 2.0 * (i.0[2] + 1.0) / (i.0[2] + 2.0))
        .when(|i| specular(i) * (i.0[2] + 8.0) / (i.0[2] + 2.0) / 4.0)
        .when(|i| specular(i) * (i.0[2] + 1.0 / PI) / (i.0[2] + 2.0) * 2.0 * PI)
        .say("the highlight is left out")
        .when(|_| 0.0)
        .say("the specular reflectance is left out of the highlight")
        .when(|i| specular(i) / i.0[1])
        .say("the highlight has the colour, too; its reflectance is `specular` alone")
        .when(|i| specular(i) * i.0[0])
        .say(LESSENED)
        .when(|i| specular(i) * (1.0 - i.0[0]))
        .say("the highlight is about the half vector, which is Blinn's; Phong's is about the mirrored light")
        .when(|i| peak(i, lobe(i, half_vector_cosine(i.2.into(), i.3.into(), i.4.into())), lit(i)))
        .say("the mirrored direction points into the surface: it is 2(n·l)n − l, not l − 2(n·l)n")
        .when(|i| peak(i, lobe(i, -alpha(i)), lit(i)))
        .say("the mirrored direction lacks a 2: it is 2(n·l)n − l")
        .when(|i| peak(i, lobe(i, (alpha(i) - towards_light(i)) / 2.0), lit(i)))
        .say("the mirrored direction has a wrong sign: it is 2(n·l)n − l")
        .when(|i| peak(i, lobe(i, alpha(i) + 2.0 * towards_light(i)), lit(i)))
        .say("n·l is missing in the mirrored direction, and normalising does not replace it: it is 2(n·l)n − l")
        .when(|i| {
            let [normal, to_light] = [i.2, i.3].map(DVec3::from);
            let cosine = (2.0 * normal - to_light).normalize().dot(i.4.into());
            peak(i, phong_peak(i.0[2]) * cosine.max(0.0).powf(i.0[2]), lit(i))
        })
        .say("the highlight is about the light itself; it is about the mirrored light")
        .when(|i| peak(i, lobe(i, towards_light(i)), lit(i)))
        .say("the highlight is about the normal; it is about the mirrored light")
        .when(|i| peak(i, lobe(i, DVec3::from(i.2).dot(i.4.into())), lit(i)))
        .say("the highlight's power is missing: its cosine to the n")
        .when(|i| peak(i, phong_peak(i.0[2]) * alpha(i).max(0.0), lit(i)))
        .say("more than 90° from the mirrored light there is no highlight, also where the power is even")
        .when(|i| peak(i, lobe(i, alpha(i).abs()), lit(i)))
        .when(|i| peak(i, phong_peak(i.0[2]) * alpha(i).powf(i.0[2]), lit(i)))
        .when(|i| peak(i, phong_peak(i.0[2]) * alpha(i).powi(i.0[2] as i32), lit(i)))
        .say(
            "0 to the power 0 is taken for 1: where cos α is not above 0 there is no highlight, whatever the \
                 exponent",
        )
        .when(|i| peak(i, phong_peak(i.0[2]) * alpha(i).max(0.0).powf(i.0[2]), lit(i)))
        .say("the highlight is about the normal, seen from the light; it is about the mirrored light")
        .when(|i| peak(i, lobe(i, cosine(i)), lit(i)))
        .say("the exponent is left out, both of the factor and of the power")
        .when(|i| peak(i, alpha(i).max(0.0) / PI, lit(i)))
        .say("the exponent is cut to a whole number; powf takes it as it is")
        .when(|i| peak(i, phong_peak(i.0[2]) * alpha(i).max(0.0).powi(i.0[2] as i32), lit(i)))
        .say("the cosine counts twice in the highlight; it lessens what arrives, once")
        .when(|i| specular(i) * lit(i))
        .say(FACES_AWAY)
        .when(|i| peak(i, lobe(i, alpha(i)), cosine(i)));
    Mistakes::<Input, f64>::new()
        .say("cos α is multiplied by the exponent; it is raised to that power")
        .when(|i| diffuse(i, lit(i)) + peak(i, phong_peak(i.0[2]) * i.0[2] * alpha(i).max(0.0), lit(i)))
        .say("the matte part is multiplied by the highlight; the two are added")
        .when(|i| diffuse(i, lit(i)) * i.0[1] * lobe(i, alpha(i)))
        .say("a surface that faces away from the light is lit from behind: the cosine lost its sign")
        .when(|i| diffuse(i, cosine(i).abs()) + peak(i, lobe(i, alpha(i)), cosine(i).abs()))
        .say("the cosine of the light's angle is missing: it counts for the highlight as for the rest")
        .when(|i| if cosine(i) > 0.0 { diffuse(i, 1.0) + peak(i, lobe(i, alpha(i)), 1.0) } else { 0.0 })
        .say("colour and specular are swapped")
        .when(|i| right(&([i.0[1], i.0[0], i.0[2]], i.1, i.2, i.3, i.4)))
        .say("the irradiance is left out")
        .when(|i| right(i) / i.1)
        .say("the cosine is the eye's; what arrives depends on the light's angle alone")
        .when(|i| {
            let eyes = DVec3::from(i.2).dot(i.4.into());
            if cosine(i) > 0.0 { diffuse(i, eyes) + peak(i, lobe(i, alpha(i)), eyes) } else { 0.0 }
        })
        .of_parts([matte, shiny], Part::new(|[matte, shiny]| matte + shiny))
}

fn asked() -> Vec<Probe<Input>> {
    let up = [0.0, 1.0, 0.0];
    let unit = |x: f64, y: f64| DVec3::new(x, y, 0.0).normalize().to_array();
    let probe = |material, to_light, to_eye| (material, 2.0, up, to_light, to_eye);
    let anywhere = |seed, low: f64, high: f64| {
        (0..40).map(move |at| {
            let mut draws = Draws::new(seed, at);
            let colour = draws.unit();
            let material = [colour, (1.0 - colour) * draws.unit(), draws.power_of_ten(low, high)];
            let normal = draws.unit_vector();
            let direction = |draws: &mut Draws, min: f64| {
                let along = draws.unit_vector_across(normal);
                (along + normal * draws.between(min, 2.0)).normalize()
            };
            let (to_light, mut to_eye) = (direction(&mut draws, -0.3), direction(&mut draws, 0.05));
            if at % 2 == 0 {
                let mirrored = 2.0 * normal.dot(to_light).abs() * normal - to_light * normal.dot(to_light).signum();
                to_eye = (mirrored + to_eye * (0.5 / libm::sqrt(1.0 + material[2]))).normalize();
            }
            (material, draws.power_of_ten(-1.0, 2.0), normal.to_array(), to_light.to_array(), to_eye.to_array())
        })
    };
    let mut asked: Vec<_> = probes("no highlight", [probe([0.8, 0.0, 10.0], unit(0.0, 1.0), unit(1.0, 1.0))]).collect();
    asked.extend(probes("the middle of a highlight", [probe([0.5, 0.4, 10.0], unit(-3.0, 4.0), unit(3.0, 4.0))]));
    asked.extend(probes("beside the middle", [probe([0.5, 0.4, 9.0], unit(-3.0, 4.0), unit(1.0, 4.0))]));
    asked.extend(probes(
        "far from the middle",
        [
            probe([0.5, 0.4, 2.0], unit(-4.0, 1.0), unit(-1.0, 0.2)),
            probe([0.5, 0.4, 3.0], unit(-4.0, 1.0), unit(-1.0, 0.2)),
        ],
    ));
    asked.extend(probes("anywhere", anywhere(1501, 0.0, 2.0)));
    asked.extend(probes("a light behind the surface", [probe([0.5, 0.4, 4.0], unit(1.0, -1.0), unit(1.0, 1.0))]));
    asked
        .extend(probes("a light in line with the surface", [probe([0.5, 0.4, 4.0], [1.0, 0.0, 0.0], unit(-1.0, 1.0))]));
    asked.extend(probes("an exponent of 0", [probe([0.5, 0.4, 0.0], unit(-3.0, 4.0), unit(1.0, 4.0))]));
    asked.extend(probes("large exponents", anywhere(1502, 2.0, 4.0)));
    asked.extend(extremes(
        "an exponent of 0, far from the middle",
        [probe([0.5, 0.4, 0.0], unit(-4.0, 1.0), unit(-1.0, 0.2))],
    ));
    asked
}

fn cosine(input: &Input) -> f64 {
    DVec3::from(input.2).dot(input.3.into())
}

/// What arrives.
fn lit(input: &Input) -> f64 {
    if cosine(input) > 0.0 { cosine(input) } else { 0.0 }
}

fn alpha(input: &Input) -> f64 {
    mirror_cosine(input.2.into(), input.3.into(), input.4.into())
}

fn lobe(input: &Input, cosine: f64) -> f64 {
    highlight(phong_peak(input.0[2]), input.0[2], cosine)
}

const FACES_AWAY: &str = "a surface that faces away from the light sends 0, and no highlight either";

const LESSENED: &str = "one part is lessened by what the other reflects; each has its own reflectance, which together \
                        are at most 1 \
                        already";

/// The cosine between the directions to the light and to the eye.
fn towards_light(input: &Input) -> f64 {
    DVec3::from(input.3).dot(input.4.into())
}

/// What the matte part sends on of light that falls with this cosine.
fn diffuse(input: &Input, cosine: f64) -> f64 {
    lambertian([input.0[0]; 3])[0] * input.1 * cosine
}

/// What a highlight so high sends on.
fn peak(input: &Input, lobe: f64, cosine: f64) -> f64 {
    input.0[1] * lobe * (input.1 * cosine)
}

fn specular(input: &Input) -> f64 {
    peak(input, lobe(input, alpha(input)), lit(input))
}

fn right(input: &Input) -> f64 {
    diffuse(input, lit(input)) + specular(input)
}

/// Radiance of Phong surfaces.
fn mine(ask: Ask<Input, f64>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::instead(
        direct_light_stage::<PhongTable>,
        move |(materials, phong): (Res<Shared<MaterialTable>>, Res<Shared<PhongTable>>),
              mut tiles: Query<(RowPlaces, &WorldRays, &Surfaces, &ShadowRays, Option<&ShadowHits>, &mut Radiance)>| {
            for (place, eye, surfaces, rays, shadows, mut radiance) in &mut tiles {
                for ray in (0..rays.rows()).filter(|&ray| shadows.is_none_or(|hits| hits.shape[ray] == NO_SHAPE)) {
                    let row = rays.row[ray] as usize;
                    let surface = surfaces.get(row);
                    let material = surface.material as usize;
                    if materials.kind[material] != MaterialKind::Phong {
                        continue;
                    }
                    let (normal, to_light) = (surface.normal.as_dvec3(), rays.direction_of(ray));
                    let (cosine, to_eye) = (normal.dot(to_light), -eye.direction_of(row));
                    let (own, colour, irradiance) =
                        (materials.row[material] as usize, materials.parameters[material].colour, rays.irradiance(ray));
                    let whole = |part: usize| {
                        let model = [colour[part], phong.specular[own][part], phong.exponent[own]];
                        let facing = f64::from(irradiance[part]) / cosine;
                        let asked = (model, facing, normal.into(), to_light.into(), to_eye.into());
                        ask.at(place, row, asked).map_or(0.0, |whole| whole as f32)
                    };
                    radiance.rgb.add(row, [whole(0), whole(1), whole(2)]);
                }
            }
        },
    )
}

/// A wide highlight: light from left to right across the normal, the eye from top to bottom.
fn painted(ask: Ask<Input, f64>) -> StandIn {
    StandIn::painted([64, 64], move |at| {
        let [light, eye] = at.map(|at| {
            let angle = (f64::from(at) - 31.5) / 32.0 * std::f64::consts::FRAC_PI_2;
            [libm::sin(angle), 0.0, libm::cos(angle)]
        });
        [ask.once(([0.2, 0.9, 2.0], 1.0, [0.0, 0.0, 1.0], light, eye)).unwrap_or_default(); 3]
    })
}
