//! Chapter 28: a ray in the object space of a mesh.

use super::mine::mine;
use glam::{DMat3, DQuat, DVec3};
use pinhole::shapes::{direction_object_from_world, point_object_from_world};
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;

/// Origin, direction, position, axes, scale.
pub(super) type Input = ([f64; 3], [f64; 3], [f64; 3], [[f64; 3]; 3], [f64; 3]);
pub(super) type Answer = [[f64; 3]; 2];

/// What the reader writes.
pub type Yours = fn([f64; 3], [f64; 3], [f64; 3], [[f64; 3]; 3], [f64; 3]) -> Answer;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    let written = move |&(o, d, position, axes, scale): &Input| yours(o, d, position, axes, scale);
    Exercise::rendered("ray_in_object_space", question, written, mine).asked_often()
}

fn question() -> Question<Input, Answer> {
    Question {
        pinhole_has: ("src/pinhole/shapes/mesh.rs", "near_ray"),
        probes: asked(),
        tell: |(origin, direction, position, axes, scale)| {
            let [origin, direction, position, scale] = [origin, direction, position, scale].map(Shown::shown);
            let axes = axes.shown();
            format!("origin {origin}, direction {direction}, position {position}, axes {axes}, scale {scale}")
        },
        right,
        apart: |yours, right| absolute(yours.as_flattened(), right.as_flattened()),
        allowed: 1e-9,
        measured: "in each part",
        mistakes: vec![
            Mistake::new(
                "the direction is of length 1 in object space too: then t counts in another unit than in the world, and hits of different meshes cannot be compared",
                |input| both(right(input)[0], DVec3::from(right(input)[1]).normalize()),
            ),
            Mistake::new(
                "the direction is not divided by the scale; in object space it is longer or shorter, too",
                |input| [right(input)[0], scaled(input, [1.0; 3])[1]],
            ),
            Mistake::new("the direction stays as it is in the world; it is turned and scaled, too", |input| {
                [right(input)[0], input.1]
            }),
            Mistake::new("the origin is not divided by the scale; it is, as the direction is", |input| {
                [scaled(input, [1.0; 3])[0], right(input)[1]]
            }),
            Mistake::new(
                "the direction is moved by the position; it is no place, and only turned and scaled",
                |input| {
                    let &(_, direction, position, axes, scale) = input;
                    [right(input)[0], right(&(direction, direction, position, axes, scale))[0]]
                },
            ),
            Mistake::new("the scale is left out", |input| scaled(input, [1.0; 3])),
            Mistake::new(
                "the ray is multiplied by the scale: what is longer in the world has the same numbers in its own space, so divide by it",
                |input| scaled(input, input.4.map(|part| 1.0 / part)),
            ),
            Mistake::new(
                "the direction is multiplied by the scale, as a normal would be; it is divided by it, as the origin is",
                |input| [right(input)[0], scaled(input, input.4.map(|part| 1.0 / part))[1]],
            ),
            Mistake::new("one factor is taken for all three axes; each has its own", |input| {
                scaled(input, [input.4[0]; 3])
            }),
            Mistake::new("the turn is to be undone before the scale, which is along the turned axes", |input| {
                let &(o, d, position, axes, scale) = input;
                [DVec3::from(o) - DVec3::from(position), d.into()]
                    .map(|v| turned_back(axes, v / DVec3::from(scale)).into())
            }),
            Mistake::new(
                "the vector is taken from object to world space; to object space each component is its product with one axis",
                |input| {
                    let &(o, d, position, axes, scale) = input;
                    right(&(o, d, position, transposed(axes), scale))
                },
            ),
            Mistake::new(
                "that leads from the object to the world; asked is the opposite: subtract the position, undo the turn, divide by the scale",
                |input| {
                    let &(o, d, position, axes, scale) = input;
                    let [o, d] = [o, d].map(|v| turned_back(transposed(axes), DVec3::from(v) * DVec3::from(scale)));
                    both((o + DVec3::from(position)).into(), d)
                },
            ),
            Mistake::new("the position is left out: the mesh is turned and scaled about its own origin", |input| {
                put_at(input, [0.0; 3])
            }),
            Mistake::new("the position is added; to come back from it, subtract it", |input| {
                put_at(input, input.2.map(|part| -part))
            }),
            Mistake::new(
                "the position is subtracted last; it was added last, in the world, so it is the first to be undone",
                |input| {
                    both(
                        (DVec3::from(put_at(input, [0.0; 3])[0]) - DVec3::from(input.2)).into(),
                        right(input)[1].into(),
                    )
                },
            ),
            Mistake::new(
                "the position is subtracted last; it was added last, in the world, so it is the first to be undone",
                |input| {
                    let &(o, _, position, axes, scale) = input;
                    let start = (turned_back(axes, o.into()) - DVec3::from(position)) / DVec3::from(scale);
                    both(start.into(), right(input)[1].into())
                },
            ),
            Mistake::new("the two are swapped: the origin is first", |input| [right(input)[1], right(input)[0]]),
        ],
        hints: &[
            "undo what placed the mesh, the last step first: the position, then the turn, then the scale",
            "a vector's component along an axis of length 1 is its dot product with that axis",
            "the direction is the difference of two places on the ray, so the position cancels in it",
            "leave the direction's length as it comes out: at each t both rays must be at the same place of the mesh",
        ],
    }
}

fn both(origin: [f64; 3], direction: DVec3) -> Answer {
    [origin, direction.into()]
}

fn scaled(&(o, d, position, axes, _): &Input, scale: [f64; 3]) -> Answer {
    right(&(o, d, position, axes, scale))
}

fn put_at(&(o, d, _, axes, scale): &Input, position: [f64; 3]) -> Answer {
    right(&(o, d, position, axes, scale))
}

fn transposed(axes: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    DMat3::from_cols_array_2d(&axes).transpose().to_cols_array_2d()
}

/// A vector's component along each axis.
fn turned_back(axes: [[f64; 3]; 3], vector: DVec3) -> DVec3 {
    DMat3::from_cols_array_2d(&axes).transpose() * vector
}

/// By the inverse matrix, as pinhole does it.
fn right(&(origin, direction, position, axes, scale): &Input) -> Answer {
    let world_from_object = DMat3::from_cols_array_2d(&axes) * DMat3::from_diagonal(scale.into());
    let object_from_world = world_from_object.inverse();
    let start = point_object_from_world(object_from_world, position.into(), origin.into());
    [start.into(), direction_object_from_world(object_from_world, direction.into()).into()]
}

fn asked() -> Vec<Probe<Input>> {
    let (here, ahead, upright) = ([0.0; 3], [0.0, 0.0, -1.0], DMat3::IDENTITY.to_cols_array_2d());
    let mut asked: Vec<_> = probes("a mesh that is not moved", [(here, ahead, here, upright, [1.0; 3])]).collect();
    asked.extend(probes("a mesh that is moved", [([0.5, 0.25, 3.0], ahead, [0.5, 0.0, -4.0], upright, [1.0; 3])]));
    asked.extend(probes("twice as large", [(here, ahead, [0.0, 0.0, -4.0], upright, [2.0; 3])]));
    asked.extend(probes("flatter", [([1.0, 1.0, 2.0], [0.6, -0.8, 0.0], here, upright, [1.0, 0.25, 1.0])]));
    let quarter = [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    asked.extend(probes("a quarter turn", [([1.0, 2.0, 3.0], [0.0, 0.6, -0.8], here, quarter, [1.0; 3])]));
    asked.extend(probes("mirrored", [([1.0, 2.0, 3.0], [0.0, 0.6, -0.8], here, upright, [-1.0, 1.0, 1.0])]));
    asked.extend(probes("any placement", (0..200).map(placed)));
    asked
}

/// A ray and a mesh anywhere, turned and scaled.
fn placed(index: u64) -> Input {
    let mut draws = Draws::new(2801, index);
    let mut three = |extent: f64| [0, 1, 2].map(|_| draws.between(-extent, extent));
    let (origin, position, turn, scale) = (three(3.0), three(3.0), three(1.0), three(1.0));
    let turn = DQuat::from_xyzw(turn[0], turn[1], turn[2], 0.5).normalize();
    let axes = DMat3::from_quat(turn).to_cols_array_2d();
    // From a quarter to four times as long.
    let scale = scale.map(|part| libm::exp2(2.0 * part));
    (origin, draws.unit_vector().into(), position, axes, scale)
}
