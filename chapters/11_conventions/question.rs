//! Chapter 11: a direction of a camera with other axes, in pinhole's.

use super::mine::mine;
use pinhole_lab::exercise::apart::exact;
use pinhole_lab::exercise::{Exercise, Mistake, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;

pub(super) type Vector = [f64; 3];
/// The direction, and whether their x points right, their y up, their z ahead.
pub(super) type Input = (Vector, bool, bool, bool);

/// What the reader writes.
pub type Yours = fn(Vector, bool, bool, bool) -> Vector;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::pinhole_from_theirs)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered(
        "pinhole_from_theirs",
        question,
        move |&(v, x_right, y_up, z_ahead)| yours(v, x_right, y_up, z_ahead),
        mine,
    )
}

fn question() -> Question<Input, Vector> {
    let every = |v: Vector| (0..8).map(move |bits| (v, bits & 1 != 0, bits & 2 != 0, bits & 4 != 0));
    let mut asked: Vec<_> =
        probes("straight ahead, in a camera that looks down +z", [([0.0, 0.0, 1.0], true, true, true)]).collect();
    asked.extend(probes("straight ahead, in a camera like pinhole's", [([0.0, 0.0, -1.0], true, true, false)]));
    asked.extend(probes("to the right, the axes in every combination", every([1.0, 2.0, 3.0])));
    asked.extend(probes(
        "a unit vector",
        (0..40).map(|at| {
            let mut draws = Draws::new(1101, at);
            let v = draws.unit_vector().to_array();
            (v, draws.unit() < 0.5, draws.unit() < 0.5, draws.unit() < 0.5)
        }),
    ));
    asked.extend(probes("parts of 0", every([0.0, 0.0, 0.0])));
    asked.extend(probes("parts of all sizes", every([1e-300, 1e300, 5e-324])));
    Question {
        pinhole_has: ("src/pinhole/rays/camera.rs", "CameraRays"),
        probes: asked,
        tell: |(v, x_right, y_up, z_ahead)| {
            format!("direction {}, x_right {x_right}, y_up {y_up}, z_ahead {z_ahead}", v.shown())
        },
        right: |&(v, x_right, y_up, z_ahead)| turned(v, !x_right, !y_up, z_ahead),
        apart: exact,
        allowed: 0.0,
        measured: "in a part",
        mistakes: vec![
            Mistake::new("the direction is handed back as it is; no axis is turned", |&(v, ..)| v),
            Mistake::new(
                "z is turned where it should not be: pinhole's points back, so theirs turns where it points ahead",
                |input| {
                    let &(v, x_right, y_up, z_ahead) = input;
                    turned(v, !x_right, !y_up, !z_ahead)
                },
            ),
            Mistake::new("z is never turned", |&(v, x_right, y_up, _)| turned(v, !x_right, !y_up, false)),
            Mistake::new(
                "x is turned where it points right, and y where it points up, which they do in pinhole's",
                |input| {
                    let &(v, x_right, y_up, z_ahead) = input;
                    turned(v, x_right, y_up, z_ahead)
                },
            ),
            Mistake::new(
                "x is turned where it points right, as it does in pinhole's",
                |&(v, x_right, y_up, z_ahead)| turned(v, x_right, !y_up, z_ahead),
            ),
            Mistake::new("x is never turned", |&(v, _, y_up, z_ahead)| turned(v, false, !y_up, z_ahead)),
            Mistake::new("y is turned where it points up, as it does in pinhole's", |&(v, x_right, y_up, z_ahead)| {
                turned(v, !x_right, y_up, z_ahead)
            }),
            Mistake::new("y is never turned", |&(v, x_right, _, z_ahead)| turned(v, !x_right, false, z_ahead)),
            Mistake::new(
                "a left-handed camera is mended by its x alone; each axis turns by itself",
                |&(v, x, y, z)| turned(v, x == (y == z), false, false),
            ),
        ],
        hints: &[
            "the three axes are the same lines in both cameras; only which end is positive differs, axis by axis",
            "pinhole's: x right, y up, z back; keep a part whose axis points in the same direction, change the sign of the others",
            "x changes its sign unless x_right, y unless y_up, and z if z_ahead",
        ],
    }
}

fn turned([x, y, z]: Vector, turn_x: bool, turn_y: bool, turn_z: bool) -> Vector {
    let sign = |turn: bool, part: f64| if turn { -part } else { part };
    [sign(turn_x, x), sign(turn_y, y), sign(turn_z, z)]
}
