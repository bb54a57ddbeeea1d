//! Chapter 15: what a Phong surface sends on of parallel light.

use super::mine::mine;
use glam::DVec3;
use pinhole::material::{half_vector_cosine, highlight, mirror_cosine, phong_peak};
use pinhole::shade::matte_radiance;
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;
use std::f64::consts::PI;

type Vector = [f64; 3];
/// Colour, specular and exponent; irradiance, normal, the directions to the light and to the eye.
pub(super) type Input = (Vector, f64, Vector, Vector, Vector);

/// What the reader writes.
pub type Yours = fn(Vector, f64, Vector, Vector, Vector) -> f64;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::phong_radiance)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered(
        "phong_radiance",
        question,
        move |&(m, e, normal, light, eye)| yours(m, e, normal, light, eye),
        mine,
    )
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
        right: |input| sent(input, lobe(input, alpha(input)), lit(input)),
        apart: |yours, right| relative(&[*yours], &[*right]),
        allowed: 1e-10,
        measured: "of the radiance",
        mistakes: vec![
            Mistake::new("a surface that faces away from the light sends 0, and no highlight either", |input| {
                sent(input, lobe(input, alpha(input)), cosine(input))
            }),
            Mistake::new(
                "the cosine of the light's angle is missing: it counts for the highlight as for the rest",
                |i| {
                    if cosine(i) > 0.0 { sent(i, lobe(i, alpha(i)), 1.0) } else { 0.0 }
                },
            ),
            Mistake::new(
                "the cosine is forgotten in the highlight; it lessens what arrives, so it counts for both",
                |i| {
                    if cosine(i) > 0.0 { sent(i, 0.0, lit(i)) + i.0[1] * lobe(i, alpha(i)) * i.1 } else { 0.0 }
                },
            ),
            Mistake::new("the factor (n + 2) / 2π of the highlight is missing", |input| {
                sent(input, lobe(input, alpha(input)) / phong_peak(input.0[2]), lit(input))
            }),
            Mistake::new(
                "the factor is that of cosⁿ alone, (n + 1) / 2π; the eye's own cosine makes it n + 2",
                |input| {
                    let factor = (input.0[2] + 1.0) / (input.0[2] + 2.0);
                    sent(input, lobe(input, alpha(input)) * factor, lit(input))
                },
            ),
            Mistake::new("the matte part is colour / π; the π is missing", |input| {
                let [colour, specular, exponent] = input.0;
                sent(
                    &([colour * PI, specular, exponent], input.1, input.2, input.3, input.4),
                    lobe(input, alpha(input)),
                    lit(input),
                )
            }),
            Mistake::new(
                "the highlight is about the half vector, which is Blinn's; Phong's is about the mirrored light",
                |i| sent(i, lobe(i, half_vector_cosine(i.2.into(), i.3.into(), i.4.into())), lit(i)),
            ),
            Mistake::new(
                "the mirrored direction points into the surface: it is 2(n·l)n − l, not l − 2(n·l)n",
                |input| sent(input, lobe(input, -alpha(input)), lit(input)),
            ),
            Mistake::new(
                "more than 90° from the mirrored light there is no highlight, also where the power is even",
                |i| sent(i, lobe(i, alpha(i).abs()), lit(i)),
            ),
        ],
        hints: &[
            "two parts, matte and highlight, each times what arrives: the irradiance times the cosine of the light's angle",
            "the highlight is specular · (n + 2) / 2π · cosⁿα, with cos α = (2(n·l)n − l) · v, and none where cos α is below 0",
            "(colour / π + specular · (n + 2) / 2π · cosⁿα) · irradiance · n·l where n·l is above 0; 0 where it is not",
        ],
    }
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
            let direction = |draws: &mut Draws, least: f64| {
                let along = draws.unit_vector_across(normal);
                (along + normal * draws.between(least, 2.0)).normalize()
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
            probe([0.5, 0.4, 0.0], unit(-4.0, 1.0), unit(-1.0, 0.2)),
        ],
    ));
    asked.extend(probes("anywhere", anywhere(1501, 0.0, 2.0)));
    asked.extend(probes("a light behind the surface", [probe([0.5, 0.4, 4.0], unit(1.0, -1.0), unit(1.0, 1.0))]));
    asked
        .extend(probes("a light in line with the surface", [probe([0.5, 0.4, 4.0], [1.0, 0.0, 0.0], unit(-1.0, 1.0))]));
    asked.extend(probes("an exponent of 0", [probe([0.5, 0.4, 0.0], unit(-3.0, 4.0), unit(1.0, 4.0))]));
    asked.extend(probes("large exponents", anywhere(1502, 2.0, 4.0)));
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

/// The radiance of a highlight so high, where the light falls with this cosine.
fn sent(&([colour, specular, _], irradiance, ..): &Input, lobe: f64, cosine: f64) -> f64 {
    let received = irradiance * cosine;
    matte_radiance([colour; 3], [received; 3])[0] + specular * lobe * received
}
