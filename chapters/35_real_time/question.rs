//! Chapter 35: how much a neighbouring pixel counts for the filter.

use super::mine::mine;
use glam::DVec3;
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;
use pinhole_lab::naive::denoise;

/// The normal, the neighbour's, the offset to it.
pub(super) type Input = ([f64; 3], [f64; 3], [f64; 3]);

/// What the reader writes.
pub type Yours = fn([f64; 3], [f64; 3], [f64; 3]) -> f64;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::edge_weight)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    let written = move |&(normal, neighbour, offset): &Input| yours(normal, neighbour, offset);
    Exercise::rendered("edge_weight", question, written, mine)
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/film/denoise.rs", "smooth_row"),
        probes: asked(),
        tell: |(normal, neighbour, offset)| {
            let [normal, neighbour, offset] = [normal, neighbour, offset].map(Shown::shown);
            format!("normal {normal}, neighbour {neighbour}, offset {offset}")
        },
        right: |input| {
            let [normal, neighbour, offset] = vectors(input);
            denoise::edge_weight(normal, neighbour, offset)
        },
        apart: |yours, right| absolute(&[*yours], &[*right]),
        allowed: 1e-9,
        measured: "",
        mistakes: vec![
            Mistake::new(
                "an offset of length 0 divides by 0: two pixels may show the same point, which lies in the plane",
                |input| if vectors(input)[2] == DVec3::ZERO { f64::NAN } else { normals(input) * plane(input) },
            ),
            Mistake::new(
                "surfaces that face away count: 32 is even, so a negative cosine has a positive power; make it 0 first",
                |input| {
                    let [normal, neighbour, _] = vectors(input);
                    power(normal.dot(neighbour)) * plane(input)
                },
            ),
            Mistake::new(
                "the distance from the plane is not divided by the offset's length: the weight then depends on the \
                 scene's units",
                |input| {
                    let [normal, _, offset] = vectors(input);
                    normals(input) * falloff(normal.dot(offset))
                },
            ),
            Mistake::new("it is the neighbour's plane: take the one across the pixel's own normal", |input| {
                let &(normal, neighbour, offset) = input;
                normals(input) * plane(&(neighbour, normal, offset))
            }),
            Mistake::new("only the normals count: light is carried across every step between parallel faces", normals),
            Mistake::new("only the plane counts: faces that meet at an edge are mixed along it", plane),
            Mistake::new("the sine is not squared: at 0.1 the weight must be one half", |input| {
                normals(input) * 0.01 / (0.01 + sine(input).abs())
            }),
            Mistake::new("the cosine lacks its 32nd power", |input| {
                let [normal, neighbour, _] = vectors(input);
                normal.dot(neighbour).max(0.0) * plane(input)
            }),
            Mistake::new(
                "that is the cosine, the part along the plane; what must be small is the part across it",
                |input| {
                    let sine = sine(input);
                    normals(input) * 0.01 / (0.01 + (1.0 - sine * sine))
                },
            ),
        ],
        hints: &[
            "the cosine of the angle between unit vectors is their dot product; below 0 the surfaces face away",
            "the 32nd power is five squarings, one after the other",
            "the dot product of normal and offset is the distance from the plane; over the offset's length it is the sine",
        ],
    }
}

fn vectors(&(normal, neighbour, offset): &Input) -> [DVec3; 3] {
    [normal, neighbour, offset].map(DVec3::from)
}

/// The 32nd power.
fn power(cosine: f64) -> f64 {
    (0..5).fold(cosine, |power, _| power * power)
}

fn falloff(sine: f64) -> f64 {
    0.01 / (0.01 + sine * sine)
}

fn sine(input: &Input) -> f64 {
    let [normal, _, offset] = vectors(input);
    normal.dot(offset.normalize_or_zero())
}

/// The factor of the normals.
fn normals(input: &Input) -> f64 {
    let [normal, neighbour, _] = vectors(input);
    power(normal.dot(neighbour).max(0.0))
}

/// The factor of the plane.
fn plane(input: &Input) -> f64 {
    falloff(sine(input))
}

fn asked() -> Vec<Probe<Input>> {
    const UP: [f64; 3] = [0.0, 1.0, 0.0];
    let tilted = |degrees: f64| [libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()), 0.0];
    let mut asked: Vec<_> = probes("a neighbour on the same floor", [(UP, UP, [0.3, 0.0, 0.4])]).collect();
    asked.extend(probes(
        "a step up",
        [(UP, UP, [0.3, 0.3, 0.0]), (UP, UP, [0.3, 0.03, 0.0]), (UP, UP, [0.03, 0.003, 0.0])],
    ));
    asked.extend(probes(
        "another normal in the plane",
        [5.0, 15.0, 40.0].map(|degrees| (UP, tilted(degrees), [0.0, 0.0, 0.2])),
    ));
    asked.extend(probes(
        "two faces of an edge",
        [(UP, tilted(20.0), [0.3, -0.05, 0.0]), (UP, tilted(30.0), [0.3, -0.08, 0.1])],
    ));
    asked.extend(probes(
        "faces that look away",
        [(UP, [0.0, -1.0, 0.0], [0.2, 0.0, 0.0]), (UP, tilted(170.0), [0.1, 0.0, 0.3])],
    ));
    asked.extend(probes("straight off the plane", [(UP, UP, [0.0, 2.0, 0.0]), (UP, UP, [0.0, -0.001, 0.0])]));
    asked.extend(probes("the same point", [(UP, UP, [0.0; 3]), (UP, tilted(10.0), [0.0; 3])]));
    asked.extend(probes("anything", (0..200).map(drawn)));
    asked
}

/// Normals that differ a little or a lot, an offset near the plane or not, in scenes of any size.
fn drawn(index: u64) -> Input {
    let mut draws = Draws::new(3501, index);
    let normal = draws.unit_vector();
    let other = (normal + draws.unit_vector() * draws.between(0.0, 1.6)).normalize();
    let across = draws.unit_vector_across(normal);
    let offset = (across + normal * draws.between(-0.3, 0.3)) * draws.power_of_ten(-3.0, 3.0);
    (normal.into(), other.into(), offset.into())
}
