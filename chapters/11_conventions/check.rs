//! Chapter 11: a direction of a camera with other axes, in pinhole's.

use bevy_ecs::prelude::*;
use pinhole::plan::{Column, VectorRowsMut};
use pinhole::rays;
use pinhole::rays::CameraRays;
use pinhole_lab::exercise::apart::exact;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Part, Question, RowPlaces, Setting, Shown, StandIn, probes};
use pinhole_lab::measure::draws::Draws;

type Vector = [f64; 3];

/// The direction, and whether their x points right, their y up, their z ahead.
type Input = (Vector, bool, bool, bool);

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
        mistakes: mistakes(),
        hints: &[
            "the three axes are the same lines in both cameras; only which end is positive differs, axis by axis",
            "pinhole's: x right, y up, z back; keep a part whose axis points in the same direction, change the sign \
             of the others",
            "which of the three flags describe pinhole's own camera where they are true, and which where it is \
             false?",
        ],
    }
}

fn mistakes() -> Mistakes<Input, Vector> {
    let x = Part::<Input, f64>::new(|i| sign(!i.1, i.0[0]))
        .say("x is turned where it points right, as it does in pinhole's")
        .when(|i| sign(i.1, i.0[0]))
        .say("x is never turned")
        .when(|i| i.0[0])
        .say("x is always turned; it turns where it points left")
        .when(|i| -i.0[0])
        .say(ZERO)
        .when(|i| if i.1 { i.0[0] } else { 0.0 });
    let y = Part::<Input, f64>::new(|i| sign(!i.2, i.0[1]))
        .say("y is turned where it points up, as it does in pinhole's")
        .when(|i| sign(i.2, i.0[1]))
        .say("y is never turned")
        .when(|i| i.0[1])
        .say("y is always turned; it turns where it points down")
        .when(|i| -i.0[1])
        .say(ZERO)
        .when(|i| if i.2 { i.0[1] } else { 0.0 });
    let z = Part::<Input, f64>::new(|i| sign(i.3, i.0[2]))
        .say("z is turned where it should not be: pinhole's points back, so theirs turns where it points ahead")
        .when(|i| sign(!i.3, i.0[2]))
        .say("z is never turned")
        .when(|i| i.0[2])
        .say("z is always turned; it turns where it points ahead")
        .when(|i| -i.0[2]);
    let whole = Part::<[f64; 3], Vector>::new(|&v| v)
        .say("the answer is brought to length 1; the length stays what it is")
        .when(|&v| if v == [0.0; 3] { v } else { divided(v) })
        .when(|&v| divided(v));
    Mistakes::<Input, Vector>::new()
        .say("a flag is asked for only where another one is set; each flag turns its own axis")
        .when(|&(v, x_right, y_up, z_ahead)| turned(v, !x_right, !y_up, x_right && z_ahead))
        .say("a bool is taken for a factor of 0 or 1; a part that is turned is multiplied by −1")
        .when(|&([x, y, z], r, u, a)| {
            [f64::from(u8::from(r)) * x, f64::from(u8::from(u)) * y, f64::from(u8::from(!a)) * z]
        })
        .say("the direction is handed back as it is; no axis is turned")
        .when(|&(v, ..)| v)
        .say("each axis has the opposite sign where its flag is true; x right and y up are pinhole's own")
        .when(|&(v, x, y, z)| turned(v, x, y, z))
        .say("all three axes are turned where they should not be, and not where they should")
        .when(|&(v, x, y, z)| turned(v, x, y, !z))
        .say("the flags of x and y are swapped")
        .when(|&(v, x, y, z)| turned(v, !y, !x, z))
        .say("the flags of y and z are swapped")
        .when(|&(v, x, y, z)| turned(v, !x, z, !y))
        .say("where y points down, y and z change places; a flag changes a sign and moves nothing")
        .when(|&([a, b, c], x, y, z)| turned(if y { [a, b, c] } else { [a, c, -b] }, !x, false, z))
        .when(|&([a, b, c], x, y, z)| turned(if y { [a, b, c] } else { [a, -c, b] }, !x, false, z))
        .when(|&([a, b, c], x, y, z)| turned(if y { [a, b, c] } else { [a, c, b] }, !x, false, z))
        .say("a left-handed camera is mended by its x alone; each axis turns by itself")
        .when(|&(v, x, y, z)| turned(v, x == (y == z), false, false))
        .say("a left-handed camera is mended by its y alone; each axis turns by itself")
        .when(|&(v, x, y, z)| turned(v, false, x == (y == z), false))
        .say("a left-handed camera is mended by its z alone; each axis turns by itself")
        .when(|&(v, x, y, z)| turned(v, false, false, x == (y == z)))
        .say(
            "the camera is given half a turn, which changes two signs; each flag changes that of its own axis \
                 only",
        )
        .when(|&(v, x, y, z)| turned(v, !x ^ z, !y, z))
        .when(|&(v, x, y, z)| turned(v, !x, !y ^ z, z))
        .when(|&(v, x, y, z)| turned(v, !x ^ !y, !y, z))
        .when(|&(v, x, y, z)| turned(v, !x, !y, z ^ !y))
        .when(|&(v, x, y, z)| turned(v, !x, !y ^ !x, z))
        .when(|&(v, x, y, z)| turned(v, !x, !y, z ^ !x))
        .when(|&(v, x, y, z)| turned(v, !x ^ z, !y ^ z, z))
        .say("the whole direction is reversed where one flag asks for it; each flag changes one sign")
        .when(|&(v, x, y, z)| turned(v, !x ^ !y ^ z, !x ^ !y ^ z, !x ^ !y ^ z))
        .when(|&(v, x, y, z)| turned(v, !x || !y || z, !x || !y || z, !x || !y || z))
        .say("y and z change places; the axes stay the same lines, and only their signs change")
        .when(|&(v, x, y, z)| swapped(v, !x, false, z, !y, 1.0))
        .when(|&(v, x, y, z)| swapped(v, !x, false, z, !y, -1.0))
        .when(|&(v, x, y, z)| swapped(v, !x, true, z, !y, 1.0))
        .when(|&(v, x, y, z)| swapped(v, !x, !y, z, z, 1.0))
        .say("only the first axis that differs is turned; all three may differ at once")
        .when(|&(v, x, y, z)| turned(v, !x, x && !y, x && y && z))
        .when(|&(v, x, y, z)| turned(v, !x && y && !z, !y && !z, z))
        .say("the direction's own signs are lost; each part keeps its sign or changes it")
        .when(|i| right(&(i.0.map(f64::abs), i.1, i.2, i.3)))
        .say("a right-handed camera's axes are left as they are; each axis turns by itself, even where two do")
        .when(|&(v, x, y, z)| if x == (y == z) { turned(v, !x, !y, z) } else { v })
        .say("x is mirrored once more in a left-handed camera; the three signs have mended that already")
        .when(|&(v, x, y, z)| turned(v, !x ^ (x == (y == z)), !y, z))
        .of_parts([x, y, z], whole)
}

fn right(&(v, x_right, y_up, z_ahead): &Input) -> Vector {
    turned(v, !x_right, !y_up, z_ahead)
}

/// Turned, and then y and z swapped where that is so, y with this sign.
fn swapped(v: Vector, turn_x: bool, turn_y: bool, turn_z: bool, swap: bool, sign: f64) -> Vector {
    let [x, y, z] = turned(v, turn_x, turn_y, turn_z);
    if swap { [x, sign * z, -sign * y] } else { [x, y, z] }
}

const ZERO: &str = "a flag that is false makes its part 0; it changes the sign";

fn sign(turn: bool, part: f64) -> f64 {
    if turn { -part } else { part }
}

fn turned([x, y, z]: Vector, turn_x: bool, turn_y: bool, turn_z: bool) -> Vector {
    [sign(turn_x, x), sign(turn_y, y), sign(turn_z, z)]
}

fn divided(v: Vector) -> Vector {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|part| part / length)
}

/// Every camera ray's direction, told in axes of which some are turned over, and turned back by the reader's function.
fn mine(ask: Ask<Input, Vector>, setting: &Setting<'_>) -> StandIn {
    let width = setting.resolution().width;
    StandIn::after(rays::perspective_stage, move |mut tiles: Query<(RowPlaces, &mut CameraRays)>| {
        for (place, mut rays) in &mut tiles {
            for row in 0..rays.rows() {
                // Each eighth of the picture has other axes, and each direction is twice as long as a unit vector.
                let eighth = 8 * place.0.pixel_of(row)[0] / width;
                let [x_right, y_up, z_ahead] = [1, 2, 4].map(|bit| eighth & bit != 0);
                let own = rays.direction(row);
                let turns = [!x_right, !y_up, z_ahead];
                let theirs = [0, 1, 2].map(|axis| if turns[axis] { -2.0 * own[axis] } else { 2.0 * own[axis] });
                if let Some([x, y, z]) = ask.at(place, row, (theirs, x_right, y_up, z_ahead)) {
                    // z loses the half that it has too much by a difference, so that a length brought to 1 is seen.
                    rays.direction.put(row, [0.5 * x, 0.5 * y, z - own.z]);
                }
            }
        }
    })
}
