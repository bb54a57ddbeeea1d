//! Chapter 11: a direction of a camera with other axes, in pinhole's.

use super::mine::mine;
use Flag::{Always, Never, Opposite, Right};
use pinhole_lab::exercise::apart::exact;
use pinhole_lab::exercise::{Exercise, Mistake, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;

pub(super) type Vector = [f64; 3];
/// The direction, and whether their x points right, their y up, their z ahead.
pub(super) type Input = (Vector, bool, bool, bool);

/// What the reader writes.
pub type Yours = fn(Vector, bool, bool, bool) -> Vector;

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
        pinhole_has: ("src/pinhole/look/convention/program.rs", "camera_axes"),
        probes: asked,
        tell: |(v, x_right, y_up, z_ahead)| {
            format!("direction {}, x_right {x_right}, y_up {y_up}, z_ahead {z_ahead}", v.shown())
        },
        right,
        apart: exact,
        allowed: 0.0,
        measured: "in a part",
        mistakes: vec![
            Mistake::new("the direction is handed back as it is; no axis is turned", |&(v, ..)| v),
            Mistake::new("each axis is turned about where its flag is true; x right and y up are pinhole's own", |i| {
                signed(i, [Opposite, Opposite, Right])
            }),
            Mistake::new(
                "z is turned where it should not be: pinhole's points back, so theirs turns where it points ahead",
                |i| signed(i, [Right, Right, Opposite]),
            ),
            Mistake::new("all three axes are turned where they should not be, and not where they should", |i| {
                signed(i, [Opposite, Opposite, Opposite])
            }),
            Mistake::new("z is never turned", |i| signed(i, [Right, Right, Never])),
            Mistake::new("z is always turned; it turns where it points ahead", |i| signed(i, [Right, Right, Always])),
            Mistake::new("x is turned where it points right, as it does in pinhole's", |i| {
                signed(i, [Opposite, Right, Right])
            }),
            Mistake::new("x is never turned", |i| signed(i, [Never, Right, Right])),
            Mistake::new("x is always turned; it turns where it points left", |i| signed(i, [Always, Right, Right])),
            Mistake::new("y is turned where it points up, as it does in pinhole's", |i| {
                signed(i, [Right, Opposite, Right])
            }),
            Mistake::new("y is never turned", |i| signed(i, [Right, Never, Right])),
            Mistake::new("y is always turned; it turns where it points down", |i| signed(i, [Right, Always, Right])),
            Mistake::new(TWO, |i| signed(i, [Never, Never, Right])),
            Mistake::new(TWO, |i| signed(i, [Right, Never, Never])),
            Mistake::new(TWO, |i| signed(i, [Never, Right, Never])),
            Mistake::new(TWO, |i| signed(i, [Opposite, Right, Opposite])),
            Mistake::new(TWO, |i| signed(i, [Right, Opposite, Opposite])),
            Mistake::new("the flags of x and y are swapped", |&(v, x, y, z)| right(&(v, y, x, z))),
            Mistake::new("the flags of y and z are swapped", |&(v, x, y, z)| right(&(v, x, !z, !y))),
            Mistake::new(
                "a left-handed camera is mended by its x alone; each axis turns by itself",
                |&(v, x, y, z)| turned(v, x == (y == z), false, false),
            ),
            Mistake::new(
                "a left-handed camera is mended by its z alone; each axis turns by itself",
                |&(v, x, y, z)| turned(v, false, false, x == (y == z)),
            ),
            Mistake::new(HALF_TURN, |&(v, x, y, z)| turned(v, !x ^ z, !y, z)),
            Mistake::new(HALF_TURN, |&(v, x, y, z)| turned(v, !x, !y ^ z, z)),
            Mistake::new(HALF_TURN, |&(v, x, y, z)| turned(v, !x ^ !y, !y, z)),
            Mistake::new(HALF_TURN, |&(v, x, y, z)| turned(v, !x, !y, z ^ !y)),
            Mistake::new(HALF_TURN, |&(v, x, y, z)| turned(v, !x, !y ^ !x, z)),
            Mistake::new(HALF_TURN, |&(v, x, y, z)| turned(v, !x, !y, z ^ !x)),
            Mistake::new(
                "the whole direction is turned about where one flag asks for it; each flag changes one sign",
                |&(v, x, y, z)| turned(v, !x ^ !y ^ z, !x ^ !y ^ z, !x ^ !y ^ z),
            ),
            Mistake::new(CHANGED, |&(v, x, y, z)| swapped(v, !x, false, z, !y, 1.0)),
            Mistake::new(CHANGED, |&(v, x, y, z)| swapped(v, !x, false, z, !y, -1.0)),
            Mistake::new(CHANGED, |&(v, x, y, z)| swapped(v, !x, true, z, !y, 1.0)),
            Mistake::new(CHANGED, |&(v, x, y, z)| swapped(v, !x, !y, z, z, 1.0)),
            Mistake::new(ONE, |&(v, x, y, z)| turned(v, !x, x && !y, x && y && z)),
            Mistake::new(ONE, |&(v, x, y, z)| turned(v, !x && y && !z, !y && !z, z)),
            Mistake::new("the answer is brought to length 1; the length stays what it is", |i| {
                let v = right(i);
                let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
                if length == 0.0 { v } else { v.map(|part| part / length) }
            }),
            Mistake::new("the answer is brought to length 1; the length stays what it is", |i| {
                let v = right(i);
                let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
                v.map(|part| part / length)
            }),
            Mistake::new(
                "a left-handed camera is mended by its y alone; each axis turns by itself",
                |&(v, x, y, z)| turned(v, false, x == (y == z), false),
            ),
            Mistake::new(
                "a flag that is false makes its part 0; it changes the sign",
                |&([x, y, z], x_right, y_up, z_ahead)| {
                    let part = |keep: bool, part: f64| if keep { part } else { 0.0 };
                    [part(x_right, x), part(y_up, y), if z_ahead { -z } else { z }]
                },
            ),
            Mistake::new("the direction's own signs are lost; each part keeps its sign or changes it", |i| {
                right(&(i.0.map(f64::abs), i.1, i.2, i.3))
            }),
            Mistake::new(HALF_TURN, |&(v, x, y, z)| turned(v, !x ^ z, !y ^ z, z)),
            Mistake::new(
                "the whole direction is turned about where one flag asks for it; each flag changes one sign",
                |&(v, x, y, z)| turned(v, !x || !y || z, !x || !y || z, !x || !y || z),
            ),
            Mistake::new(TWO, |i| signed(i, [Never, Never, Opposite])),
            Mistake::new(TWO, |i| signed(i, [Opposite, Opposite, Never])),
            Mistake::new(
                "a right-handed camera's axes are left as they are; each axis turns by itself, even where two do",
                |&(v, x, y, z)| if x == (y == z) { turned(v, !x, !y, z) } else { v },
            ),
            Mistake::new(
                "x is mirrored once more in a left-handed camera; the three signs have mended that already",
                |&(v, x, y, z)| turned(v, !x ^ (x == (y == z)), !y, z),
            ),
        ],
        hints: &[
            "the three axes are the same lines in both cameras; only which end is positive differs, axis by axis",
            "pinhole's: x right, y up, z back; keep a part whose axis points in the same direction, change the sign \
             of the others",
            "x changes its sign unless x_right, y unless y_up, and z if z_ahead",
        ],
    }
}

fn turned([x, y, z]: Vector, turn_x: bool, turn_y: bool, turn_z: bool) -> Vector {
    let sign = |turn: bool, part: f64| if turn { -part } else { part };
    [sign(turn_x, x), sign(turn_y, y), sign(turn_z, z)]
}

const TWO: &str = "two axes are turned wrongly: x changes its sign unless x_right, y unless y_up, and z if z_ahead";
const HALF_TURN: &str =
    "the camera is given half a turn, which changes two signs; each flag changes that of its own axis only";
const CHANGED: &str = "y and z change places; the axes stay the same lines, and only their signs change";
const ONE: &str = "only the first axis that differs is turned; all three may differ at once";

/// When an axis is turned.
enum Flag {
    Right,
    Opposite,
    Never,
    Always,
}

fn right(&(v, x_right, y_up, z_ahead): &Input) -> Vector {
    turned(v, !x_right, !y_up, z_ahead)
}

fn signed(&(v, x_right, y_up, z_ahead): &Input, flags: [Flag; 3]) -> Vector {
    let turn = |flag: &Flag, right: bool| match flag {
        Right => right,
        Opposite => !right,
        Never => false,
        Always => true,
    };
    let [x, y, z] = &flags;
    turned(v, turn(x, !x_right), turn(y, !y_up), turn(z, z_ahead))
}

/// Turned, and then y and z swapped where that is so, y with this sign.
fn swapped(v: Vector, turn_x: bool, turn_y: bool, turn_z: bool, swap: bool, sign: f64) -> Vector {
    let [x, y, z] = turned(v, turn_x, turn_y, turn_z);
    if swap { [x, sign * z, -sign * y] } else { [x, y, z] }
}
