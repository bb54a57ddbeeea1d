//! Chapter 14: the cosine at which light falls on a triangle whose corners have normals.

use super::mine::mine;
use glam::DVec3;
use pinhole::intersect;
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;

type Vector = [f64; 3];
/// The triangle's own normal, its corners' normals, the barycentric coordinates, the directions to the eye and to the light.
pub(super) type Input = (Vector, [Vector; 3], Vector, Vector, Vector);

/// What the reader writes.
pub type Yours = fn(Vector, [Vector; 3], Vector, Vector, Vector) -> f64;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::falling_cosine)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered(
        "falling_cosine",
        question,
        move |&(geometric, normals, weights, eye, light)| yours(geometric, normals, weights, eye, light),
        mine,
    )
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/intersect/shading_normal.rs", "falling_cosine"),
        probes: asked(),
        tell: |(geometric, normals, weights, eye, light)| {
            let [geometric, weights, eye, light] = [geometric, weights, eye, light].map(Shown::shown);
            format!(
                "geometric {geometric}, normals {}, weights {weights}, to_eye {eye}, to_light {light}",
                normals.shown()
            )
        },
        right: |input| cosine(input, turned(input)).max(0.0),
        apart: |yours, right| absolute(&[*yours], &[*right]),
        allowed: 1e-12,
        measured: "of the cosine",
        mistakes: vec![
            Mistake::new("light falls as the surface lies, whatever its corners' normals are", |input| {
                cosine(input, faced(input)).max(0.0)
            }),
            Mistake::new("the mixed normal is not brought to length 1", |input| {
                cosine(input, turned(input) * mixed(input).length()).max(0.0)
            }),
            Mistake::new(
                "light comes from below the surface, where the mixed normal leans to it; that counts as none",
                |input| turned(input).dot(light(input)).max(0.0),
            ),
            Mistake::new("the answer is negative where the mixed normal faces away; it is 0", |input| {
                cosine(input, turned(input))
            }),
            Mistake::new("the mixed normal is not turned to the eye's side of the surface", |input| {
                cosine(input, mixed(input).normalize()).max(0.0)
            }),
            Mistake::new(
                "the mixed normal is turned to the eye by its own direction; what counts is the side of the surface on which the \
                 eye is",
                |input| {
                    let (mixed, eye) = (mixed(input).normalize(), DVec3::from(input.3));
                    cosine(input, if mixed.dot(eye) < 0.0 { -mixed } else { mixed }).max(0.0)
                },
            ),
            Mistake::new("the direction to the light is not brought to length 1", |input| {
                cosine(input, turned(input)).max(0.0) * DVec3::from(input.4).length()
            }),
        ],
        hints: &[
            "three steps: mix the corners' normals by the weights; see on which side of the triangle eye and light are; \
             take the cosine",
            "the sum of weights times normals is shorter than 1; turn it so that it lies on the eye's side of the triangle, \
             which its scalar product with `geometric` tells",
            "0 where geometric · to_eye and geometric · to_light have different signs; else the cosine between the mixed \
             normal, on their side, and to_light, and 0 where that is negative",
        ],
    }
}

fn mixed((_, normals, weights, ..): &Input) -> DVec3 {
    normals.iter().zip(weights).map(|(&normal, &weight)| DVec3::from(normal) * weight).sum()
}

/// The triangle's own normal on the eye's side.
fn faced(&(geometric, _, _, eye, _): &Input) -> DVec3 {
    let geometric = DVec3::from(geometric);
    if geometric.dot(DVec3::from(eye)) < 0.0 { -geometric } else { geometric }
}

/// The mixed one there, a unit vector.
fn turned(input: &Input) -> DVec3 {
    let mixed = mixed(input).normalize();
    if mixed.dot(faced(input)) < 0.0 { -mixed } else { mixed }
}

fn light(input: &Input) -> DVec3 {
    DVec3::from(input.4).normalize()
}

/// As pinhole has it.
fn cosine(input: &Input, normal: DVec3) -> f64 {
    intersect::falling_cosine(faced(input), normal, light(input))
}

fn asked() -> Vec<Probe<Input>> {
    let up = DVec3::Y.to_array();
    let leaning = [[-0.6, 0.8, 0.0], [0.6, 0.8, 0.0], [0.0, 0.8, 0.6]];
    let third = [1.0 / 3.0; 3];
    let (above, aside) = ([0.0, 4.0, 1.0], [3.0, 4.0, 0.0]);
    let mut asked: Vec<_> = probes("at a corner", [(up, leaning, [1.0, 0.0, 0.0], above, aside)]).collect();
    asked.extend(probes(
        "between corners",
        [(up, leaning, third, above, aside), (up, leaning, [0.5, 0.5, 0.0], above, aside)],
    ));
    asked.extend(probes("corners' normals all alike", [(up, [up; 3], third, above, aside)]));
    let down = DVec3::NEG_Y.to_array();
    asked.extend(probes("the triangle's own normal points down", [(down, leaning, third, above, aside)]));
    let below = |direction: Vector| direction.map(|part| -part);
    asked.extend(probes("eye and light below", [(up, leaning, third, below(above), below(aside))]));
    asked.extend(probes("the light below, the eye above", [(up, leaning, third, above, below(aside))]));
    let low = [5.0, -0.5, 0.0];
    asked.extend(probes(
        "light from just below, to which a corner's normal leans",
        [(up, leaning, [0.0, 1.0, 0.0], above, low)],
    ));
    asked.extend(probes(
        "light from just above, from which it leans away",
        [(up, leaning, [1.0, 0.0, 0.0], above, [5.0, 0.5, 0.0])],
    ));
    asked.extend(probes(
        "an eye from which it leans away",
        [(up, leaning, [1.0, 0.0, 0.0], [5.0, 0.5, 0.0], [-1.0, 3.0, 0.0])],
    ));
    asked.extend(probes("anywhere", (0..120).map(somewhere)));
    asked
}

fn somewhere(at: u64) -> Input {
    let mut draws = Draws::new(1401, at);
    let geometric = draws.unit_vector();
    let side = if at.is_multiple_of(2) { 1.0 } else { -1.0 };
    let normals = [(); 3].map(|()| (geometric * (side * 1.05) + draws.unit_vector()).normalize().to_array());
    let (a, b) = (draws.unit(), draws.unit());
    let weights = if a + b > 1.0 { [1.0 - a, 1.0 - b, a + b - 1.0] } else { [a, b, 1.0 - a - b] };
    let eye = draws.unit_vector() * draws.power_of_ten(-1.0, 2.0);
    let light = draws.unit_vector() * draws.power_of_ten(-1.0, 2.0);
    (geometric.to_array(), normals, weights, eye.to_array(), light.to_array())
}
