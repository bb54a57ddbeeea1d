//! Chapter 15: what a Phong surface sends on of parallel light.

use super::mine::mine;
use glam::DVec3;
use pinhole::material::{half_vector_cosine, highlight, lambertian, mirror_cosine, phong_peak};
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, extremes, probes};
use pinhole_lab::measure::ray_aim::Draws;
use std::f64::consts::PI;

type Vector = [f64; 3];
/// Colour, specular and exponent; irradiance, normal, the directions to the light and to the eye.
pub(super) type Input = (Vector, f64, Vector, Vector, Vector);

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
        mistakes: vec![
            Mistake::new(FACES_AWAY, |i| sent(i, lobe(i, alpha(i)), cosine(i))),
            Mistake::new(
                "a surface that faces away from the light is lit from behind: the cosine lost its sign",
                |i| sent(i, lobe(i, alpha(i)), cosine(i).abs()),
            ),
            Mistake::new(
                "the cosine of the light's angle is missing: it counts for the highlight as for the rest",
                |i| if cosine(i) > 0.0 { sent(i, lobe(i, alpha(i)), 1.0) } else { 0.0 },
            ),
            Mistake::new(NO_COSINE, |i| if cosine(i) > 0.0 { apart(i, lit(i), 1.0, 1.0) } else { 0.0 }),
            Mistake::new(NO_COSINE, |i| apart(i, lit(i), 1.0, 1.0)),
            Mistake::new(
                "the cosine is forgotten in the matte part; it lessens what arrives, so it counts for both",
                |i| {
                    if cosine(i) > 0.0 { apart(i, 1.0, lit(i), 1.0) } else { 0.0 }
                },
            ),
            Mistake::new("the irradiance is left out of the highlight; it sends on what arrives, too", |i| {
                apart(i, lit(i), lit(i) / i.1, 1.0)
            }),
            Mistake::new(
                "the irradiance and the cosine are left out of the highlight; it sends on what arrives, too",
                |i| {
                    if cosine(i) > 0.0 { apart(i, lit(i), 1.0 / i.1, 1.0) } else { 0.0 }
                },
            ),
            Mistake::new("the factor (n + 2) / 2π of the highlight is missing", |i| {
                scaled(i, |n| 2.0 * PI / (n + 2.0))
            }),
            Mistake::new(
                "the factor is that of cosⁿ alone, (n + 1) / 2π; the eye's own cosine makes it n + 2",
                |i| scaled(i, |n| (n + 1.0) / (n + 2.0)),
            ),
            Mistake::new(FACTOR, |i| scaled(i, |_| 2.0)),
            Mistake::new(FACTOR, |i| scaled(i, |_| PI * PI)),
            Mistake::new(FACTOR, |i| scaled(i, |_| 0.5)),
            Mistake::new(FACTOR, |i| scaled(i, |_| 2.0 * PI)),
            Mistake::new(FACTOR, |i| scaled(i, |_| PI)),
            Mistake::new(FACTOR, |i| scaled(i, |_| 1.0 / PI)),
            Mistake::new(FACTOR, |i| scaled(i, |n| 2.0 / (n + 2.0))),
            Mistake::new(FACTOR, |i| scaled(i, |n| n / (n + 2.0))),
            Mistake::new(FACTOR, |i| scaled(i, |n| 2.0 * (n + 1.0) / (n + 2.0))),
            Mistake::new(FACTOR, |i| scaled(i, |n| (n + 8.0) / (n + 2.0) / 4.0)),
            Mistake::new("the matte part is colour / π; the π is missing", |i| apart(i, lit(i) * PI, lit(i), 1.0)),
            Mistake::new("the matte part is colour / π, not colour / 2π", |i| apart(i, lit(i) / 2.0, lit(i), 1.0)),
            Mistake::new("the matte part is left out", |i| apart(i, 0.0, lit(i), 1.0)),
            Mistake::new("the highlight is left out", |i| apart(i, lit(i), 0.0, 1.0)),
            Mistake::new("the specular reflectance is left out of the highlight", |i| {
                apart(i, lit(i), lit(i) / i.0[1], 1.0)
            }),
            Mistake::new("the highlight has the colour, too; its reflectance is `specular` alone", |i| {
                apart(i, lit(i), lit(i) * i.0[0], 1.0)
            }),
            Mistake::new(LESSENED, |i| apart(i, lit(i) * (1.0 - i.0[1]), lit(i), 1.0)),
            Mistake::new(LESSENED, |i| apart(i, lit(i) * (1.0 - i.0[1] / i.0[0]), lit(i), 1.0)),
            Mistake::new(LESSENED, |i| apart(i, lit(i), lit(i) * (1.0 - i.0[0]), 1.0)),
            Mistake::new("colour and specular are swapped", |i| right(&([i.0[1], i.0[0], i.0[2]], i.1, i.2, i.3, i.4))),
            Mistake::new(
                "the highlight is about the half vector, which is Blinn's; Phong's is about the mirrored light",
                |i| sent(i, lobe(i, half_vector_cosine(i.2.into(), i.3.into(), i.4.into())), lit(i)),
            ),
            Mistake::new(
                "the mirrored direction points into the surface: it is 2(n·l)n − l, not l − 2(n·l)n",
                |i| sent(i, lobe(i, -alpha(i)), lit(i)),
            ),
            Mistake::new("the mirrored direction lacks a 2: it is 2(n·l)n − l", |i| {
                sent(i, lobe(i, (alpha(i) - towards_light(i)) / 2.0), lit(i))
            }),
            Mistake::new("the mirrored direction has a wrong sign: it is 2(n·l)n − l", |i| {
                sent(i, lobe(i, alpha(i) + 2.0 * towards_light(i)), lit(i))
            }),
            Mistake::new(
                "n·l is missing in the mirrored direction, and normalising does not replace it: it is 2(n·l)n − l",
                |i| {
                    let [normal, to_light] = [i.2, i.3].map(DVec3::from);
                    let cosine = (2.0 * normal - to_light).normalize().dot(i.4.into());
                    sent(i, phong_peak(i.0[2]) * cosine.max(0.0).powf(i.0[2]), lit(i))
                },
            ),
            Mistake::new("the highlight is about the light itself; it is about the mirrored light", |i| {
                sent(i, lobe(i, towards_light(i)), lit(i))
            }),
            Mistake::new("the highlight is about the normal; it is about the mirrored light", |i| {
                sent(i, lobe(i, DVec3::from(i.2).dot(i.4.into())), lit(i))
            }),
            Mistake::new("the highlight's power is missing: its cosine to the n", |i| {
                sent(i, phong_peak(i.0[2]) * alpha(i).max(0.0), lit(i))
            }),
            Mistake::new(EVEN, |i| sent(i, lobe(i, alpha(i).abs()), lit(i))),
            Mistake::new(EVEN, |i| sent(i, phong_peak(i.0[2]) * alpha(i).powf(i.0[2]), lit(i))),
            Mistake::new(EVEN, |i| sent(i, phong_peak(i.0[2]) * alpha(i).powi(i.0[2] as i32), lit(i))),
            Mistake::new(
                "0 to the power 0 is taken for 1: where cos α is not above 0 there is no highlight, whatever the \
                 exponent",
                |i| sent(i, phong_peak(i.0[2]) * alpha(i).max(0.0).powf(i.0[2]), lit(i)),
            ),
            Mistake::new(
                "the matte part is left out where there is no highlight; it has nothing to do with the eye",
                |i| {
                    if alpha(i) > 0.0 { right(i) } else { 0.0 }
                },
            ),
            Mistake::new(
                "the highlight is about the normal, seen from the light; it is about the mirrored light",
                |i| sent(i, lobe(i, cosine(i)), lit(i)),
            ),
            Mistake::new("the exponent is left out, both of the factor and of the power", |i| {
                apart(i, lit(i), 0.0, 1.0) + i.0[1] * alpha(i).max(0.0) / PI * i.1 * lit(i)
            }),
            Mistake::new("the matte part has the factor of the highlight, too; it is colour / π", |i| {
                let factor = phong_peak(i.0[2]) * PI;
                apart(i, lit(i) * factor, lit(i), 1.0)
            }),
            Mistake::new(FACTOR, |i| scaled(i, |n| (n + 1.0 / PI) / (n + 2.0) * 2.0 * PI)),
            Mistake::new(
                "both factors are missing, 1 / π of the matte part and (n + 2) / 2π of the highlight",
                |i| apart(i, lit(i) * PI, lit(i), 1.0 / phong_peak(i.0[2])),
            ),
            Mistake::new("the highlight lacks its factor (n + 2) / 2π and the cosine of the light's angle", |i| {
                if cosine(i) > 0.0 { apart(i, lit(i), 1.0, 1.0 / phong_peak(i.0[2])) } else { 0.0 }
            }),
            Mistake::new(
                "both factors are missing, 1 / π of the matte part and (n + 2) / 2π of the highlight, which lacks the \
                 cosine, too",
                |i| if cosine(i) > 0.0 { apart(i, lit(i) * PI, 1.0, 1.0 / phong_peak(i.0[2])) } else { 0.0 },
            ),
            Mistake::new("the exponent is cut to a whole number; powf takes it as it is", |i| {
                sent(i, phong_peak(i.0[2]) * alpha(i).max(0.0).powi(i.0[2] as i32), lit(i))
            }),
            Mistake::new("the irradiance is left out", |i| right(i) / i.1),
            Mistake::new("the colour is left out of the matte part", |i| apart(i, lit(i) / i.0[0], lit(i), 1.0)),
            Mistake::new("the cosine counts twice in the highlight; it lessens what arrives, once", |i| {
                apart(i, lit(i), lit(i) * lit(i), 1.0)
            }),
            Mistake::new("the cosine is the eye's; what arrives depends on the light's angle alone", |i| {
                if cosine(i) > 0.0 { sent(i, lobe(i, alpha(i)), DVec3::from(i.2).dot(i.4.into())) } else { 0.0 }
            }),
            Mistake::new(FACES_AWAY, |i| apart(i, lit(i), cosine(i).abs(), 1.0)),
        ],
        hints: &[
            "two parts, matte and highlight, each times what arrives: the irradiance times the cosine of the light's \
             angle",
            "the highlight is specular · (n + 2) / 2π · cosⁿα, with cos α = (2(n·l)n − l) · v, and none where cos α \
             is below 0",
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

/// The radiance of a highlight so high, where the light falls with this cosine.
fn sent(&([colour, specular, _], irradiance, ..): &Input, lobe: f64, cosine: f64) -> f64 {
    let received = irradiance * cosine;
    lambertian([colour; 3])[0] * received + specular * lobe * received
}

const NO_COSINE: &str = "the cosine is forgotten in the highlight; it lessens what arrives, so it counts for both";
const FACES_AWAY: &str = "a surface that faces away from the light sends 0, and no highlight either";
const FACTOR: &str = "the factor of the highlight is another one; it is (n + 2) / 2π, all of 2π below the line";
const LESSENED: &str = "one part is lessened by what the other reflects; each has its own reflectance, which together \
                        are at most 1 \
                        already";
const EVEN: &str = "more than 90° from the mirrored light there is no highlight, also where the power is even";

fn right(input: &Input) -> f64 {
    sent(input, lobe(input, alpha(input)), lit(input))
}

/// Matte part and highlight with what arrives for each, and the highlight's height times a factor.
fn apart(input: &Input, matte: f64, shiny: f64, factor: f64) -> f64 {
    let highlight = if shiny == 0.0 { 0.0 } else { input.0[1] * lobe(input, alpha(input)) * factor * input.1 * shiny };
    sent(input, 0.0, matte) + highlight
}

fn scaled(input: &Input, factor: fn(f64) -> f64) -> f64 {
    apart(input, lit(input), lit(input), factor(input.0[2]))
}

/// The cosine between the directions to the light and to the eye.
fn towards_light(input: &Input) -> f64 {
    DVec3::from(input.3).dot(input.4.into())
}
