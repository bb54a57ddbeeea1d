//! Chapter 02: a vector brought to length 1, whatever its size.

use bevy_ecs::prelude::*;
use pinhole::extract::PerspectiveProjection;
use pinhole::plan::{Column, Shared, VectorRowsMut};
use pinhole::rays;
use pinhole::rays::{CameraRays, ScreenPoints};
use pinhole_lab::exercise::apart::{absolute, option};
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Question, RowPlaces, Setting, Shown, StandIn, extremes, probes};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::exact::Dyadic;
use pinhole_lab::measure::exact_vector::ExactVector;

type Vector = [f64; 3];

/// What the reader writes.
pub type Yours = fn(Vector) -> Option<Vector>;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("unit", question, move |&v| yours(v), mine).and_in("vectors 1e308 long", |_| ())
}

fn question() -> Question<Vector, Option<Vector>> {
    let sized = |seed, low, high| {
        (0..20).map(move |at| {
            let mut draws = Draws::new(seed, at);
            (draws.unit_vector() * draws.power_of_ten(low, high)).to_array()
        })
    };
    let (nan, infinite) = (f64::NAN, f64::INFINITY);
    let mut asked: Vec<_> = probes("a vector along an axis", [[2.0, 0.0, 0.0], [0.0, 0.0, -0.25]]).collect();
    asked.extend(probes("3, 4 and 12, of length 13", [[3.0, 4.0, 12.0], [-3.0, 4.0, -12.0]]));
    asked.extend(probes("a vector of ordinary size", sized(201, -3.0, 3.0)));
    asked.extend(probes("the vector 0, which has no direction", [[0.0; 3], [-0.0, 0.0, -0.0]]));
    asked.extend(probes("with a part that is NaN", [[nan, 1.0, 0.0], [0.0, 0.0, nan], [nan, nan, nan]]));
    asked.extend(probes(
        "with an infinite part",
        [[infinite, 1.0, 0.0], [0.0, -infinite, infinite], [nan, infinite, 0.0]],
    ));
    asked.extend(extremes("so long that its squares overflow", [[1e200, 0.0, 0.0], [-1e200, 2e200, 1e199]]));
    asked.extend(extremes("so long that its squares overflow", sized(202, 160.0, 300.0)));
    asked.extend(extremes("as long as f64 goes", [[f64::MAX, f64::MAX, -f64::MAX]]));
    asked.extend(extremes("so short that its squares are 0", [[1e-200, 0.0, 0.0], [3e-200, -4e-200, 0.0]]));
    asked.extend(extremes("so short that its squares are 0", sized(203, -300.0, -165.0)));
    asked.extend(extremes("so short that its squares have few digits left", sized(204, -162.0, -155.0)));
    asked.extend(extremes("subnormal", [[5e-324, 0.0, 0.0], [1.5e-323, 2e-323, 0.0], [5e-324, -5e-324, 5e-324]]));
    Question {
        pinhole_has: ("src/pinhole/extract/pose.rs", "fn direction"),
        probes: asked,
        tell: |v| format!("v {}", v.shown()),
        right: |&v| unit(v),
        apart: |yours, right| option(yours, right, |yours, right| absolute(yours, right)),
        allowed: 1e-15,
        measured: "in a part",
        mistakes: Mistakes::<Vector, Option<Vector>>::new()
            .say("each part is brought to 1 by itself; all are divided by the same length")
            .when(|&v| Some(v.map(|part| part / (part * part).sqrt())))
            .say("a small number is added to the length, which makes the answer too short; ask for 0 instead")
            .when(|&v| unit(v).map(|_| divided(v, length(v) + 1e-8)))
            .when(|&v| unit(v).map(|_| divided(v, length(v) + 1e-6)))
            .say("the vector is multiplied by its length; divide by it")
            .when(|&v| unit(v).map(|_| v.map(|part| part * length(v))))
            .say("f32 is computed in, which has seven digits")
            .when(|&v| unit(v).map(|_| divided(v, f64::from(((length(v) * length(v)) as f32).sqrt()))))
            .say("one part is left out of the length; it is √(x² + y² + z²)")
            .when(|&v @ [x, y, _]| unit(v).map(|_| divided(v, length([x, y, 0.0]))))
            .when(|&v @ [x, _, z]| unit(v).map(|_| divided(v, length([x, 0.0, z]))))
            .when(|&v @ [_, y, z]| unit(v).map(|_| divided(v, length([0.0, y, z]))))
            .say("what has no direction is given one: 0, NaN and infinite parts must give None")
            .when(|&v| Some(unit(v).unwrap_or_else(|| plain(v))))
            .when(|&v| Some(unit(v).unwrap_or_else(|| if v == [0.0; 3] { v } else { plain(v) })))
            .when(|&v| unit(v).or_else(|| (v != [0.0; 3]).then(|| plain(v))))
            .when(|&v| unit(v).or_else(|| (v != [0.0; 3]).then_some([f64::NAN; 3])))
            .say("an infinite part leaves no direction: the answer there is None")
            .when(|&v| {
                if v.iter().any(|part| part.is_nan()) {
                    None
                } else {
                    unit(v).or_else(|| (!finite(v)).then(|| plain(v)))
                }
            })
            .when(|&v| {
                let is_infinite = largest(v) == f64::INFINITY && !v.iter().any(|part| part.is_nan());
                unit(v).or_else(|| is_infinite.then_some([f64::NAN; 3]))
            })
            .say("the vector is divided by its length as it stands, whose squares overflow or vanish")
            .when(|&v| finite(plain(v)).then(|| plain(v)))
            .say(
                "an infinite part is divided by an infinite length, and long vectors, whose squares overflow, too: \
                 the first must give None, and the others need their parts made smaller first",
            )
            .when(|&v| (length(v) > 0.0).then(|| plain(v)))
            .say(
                "the vector is divided by its length whatever that is: 0, NaN and infinite parts must give None, \
                 and the squares overflow or vanish",
            )
            .when(|&v| Some(plain(v)))
            .say(
                "vectors whose squares overflow or vanish are given None, but they have a direction: divide by the \
                 largest part first",
            )
            .when(|&v| (length(v) > 0.0 && length(v).is_finite()).then(|| plain(v)))
            .say(
                "short vectors are taken for 0, and of long ones the squares overflow; however short or long one is, \
                 it has a direction: divide by the largest part first",
            )
            .when(|&v| (length(v) > 1e-12 && length(v).is_finite()).then(|| plain(v)))
            .say(
                "the length itself overflows, or is rounded coarsely, at the ends of f64: divide by the largest \
                 part first",
            )
            .when(|&v| (finite(v) && v != [0.0; 3]).then(|| divided(v, v[0].hypot(v[1]).hypot(v[2]))))
            .when(|&v| {
                let length = v[0].hypot(v[1]).hypot(v[2]);
                (length > 0.0 && length.is_finite()).then(|| divided(v, length))
            })
            .say("short vectors are taken for 0; however short one is, it has a direction")
            .when(|&v| unit(v).filter(|_| length(v) > 1e-12))
            .when(|&v| unit(v).filter(|_| length(v) * length(v) > f64::EPSILON))
            .when(|&v| unit(v).filter(|_| largest(v) > f64::MIN_POSITIVE))
            .when(|&v| unit(v).filter(|_| largest(v) > 1e-300))
            .say("the vector is divided by its squared length: a square root is missing")
            .when(|&v| Some(divided(v, length(v) * length(v))))
            .say("the vector is divided by the root of its length: one square root is too many")
            .when(|&v| Some(divided(v, length(v).sqrt())))
            .say("the vector is divided by its largest part, which makes that part 1, not the length")
            .when(|&v| {
                let largest = largest(v);
                (largest > 0.0 && largest.is_finite()).then(|| divided(v, largest))
            })
            .say("the length is taken for |x| + |y| + |z|; it is √(x² + y² + z²)")
            .when(|&v| unit(v).map(|_| divided(v, v.iter().map(|part| part.abs()).sum())))
            .say("the length is taken for x + y + z; it is √(x² + y² + z²)")
            .when(|&v| unit(v).map(|_| divided(v, v.iter().sum())))
            .say(
                "the length is that of the vector divided by its largest part; v itself has `largest` times that \
                 length",
            )
            .when(|&v| unit(v).map(|_| divided(v, length(divided(v, largest(v))))))
            .say("one part that is 0 is taken for the vector 0, which has three")
            .when(|&v| unit(v).filter(|_| !v.contains(&0.0)))
            .say(
                "the largest part is taken with its sign, so that a negative one counts as small; compare absolute \
                 values",
            )
            .when(|&v| unit(v).map(|_| scaled(v, v[0].max(v[1]).max(v[2]))))
            .when(|&v| unit(v).map(|_| scaled(v, v[0].max(v[1]).max(v[2]))).filter(|&v| finite(v)))
            .say("the vector is divided by its smallest part, which may be 0; the largest is meant")
            .when(|&v| unit(v).map(|_| scaled(v, v.iter().fold(f64::MAX, |min, part| part.abs().min(min)))))
            .say("the vector is handed back as it is")
            .when(|&v| unit(v).map(|_| v))
            .say("the direction points the opposite way")
            .when(|&v| unit(v).map(|v| v.map(|part| -part)))
            .say("only a vector longer than 1 is made shorter; a shorter one is to be made longer")
            .when(|&v| unit(v).map(|unit| if length(v) > 1.0 { unit } else { v }))
            .say("the signs are lost; the direction keeps those of v")
            .when(|&v| unit(v).map(|v| v.map(f64::abs)))
            .say("each part is brought to 1 by itself; all are divided by the same length")
            .when(|&v| unit(v).map(|_| v.map(f64::signum)))
            .say("f32 is computed in, which has seven digits")
            .when(|&v| unit(v).map(|_| plain(v.map(|part| f64::from(part as f32))).map(|part| f64::from(part as f32))))
            .say(
                "the vector is multiplied by 1 / largest, which is infinite for a subnormal one: divide by the \
                 largest part",
            )
            .when(|&v| unit(v).map(|_| plain(v.map(|part| part * (1.0 / largest(v))))))
            .say("a part that is NaN or infinite leaves no direction, and max passes NaN over: ask all three parts")
            .when(|&v| unit(v).or_else(|| (largest(v) > 0.0).then_some([f64::NAN; 3])))
            .when(|&v| {
                let is_seen = v != [0.0; 3] && (largest(v) > 0.0 || v.iter().all(|part| part.is_nan()));
                unit(v).or_else(|| is_seen.then_some([f64::NAN; 3]))
            })
            .when(|&v| unit(v).or_else(|| (largest(v) > 0.0 && largest(v).is_finite()).then_some([f64::NAN; 3])))
            .say("v is divided by its largest part, then by the length of v; the divided vector's own length is meant")
            .when(|&v| unit(v).map(|_| divided(divided(v, largest(v)), length(v)))),
        hints: &[
            "divide by the length; then ask what has no direction at all",
            "squares of 1e200 and of 1e-200 do not fit in f64; but the direction of v and that of v / 1e200 are the same",
            "make the vector small before you square it: by which of its own parts can it be divided without being \
             turned round?",
        ],
    }
}

/// The exact direction, rounded once.
fn unit(v: Vector) -> Option<Vector> {
    if !v.iter().all(|part| part.is_finite()) || v == [0.0; 3] {
        return None;
    }
    let length = ExactVector::of(v).length();
    Some(v.map(|part| Dyadic::of(part).divided_by(&length).to_f64()))
}

fn plain(v: Vector) -> Vector {
    divided(v, length(v))
}

fn largest(v: Vector) -> f64 {
    v.iter().fold(0.0, |largest, part| part.abs().max(largest))
}

fn length(v: Vector) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

fn divided(v: Vector, by: f64) -> Vector {
    v.map(|part| part / by)
}

fn finite(v: Vector) -> bool {
    v.iter().all(|part| part.is_finite())
}

/// Divided by some number first, and then by the length.
fn scaled(v: Vector, by: f64) -> Vector {
    plain(divided(v, by))
}

/// The vector from the eye to a point of the image plane, brought to length 1 by the reader's function.
fn mine(ask: Ask<Vector, Option<Vector>>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::after(
        rays::perspective_stage,
        move |camera: Res<Shared<PerspectiveProjection>>,
              mut tiles: Query<(RowPlaces, &ScreenPoints, &mut CameraRays)>| {
            for (place, screen, mut rays) in &mut tiles {
                for row in 0..screen.rows() {
                    let tangent = camera.tan_half_vertical;
                    let point = [screen.point[0][row] * tangent, screen.point[1][row] * tangent, -1.0];
                    if let Some(direction) = ask.at(place, row, point) {
                        // Where there is no direction, no ray leaves.
                        rays.direction.put(row, direction.unwrap_or_default());
                    }
                }
            }
        },
    )
}

/// Vectors whose length is beyond f64, with parts that are 0 in the middle column and line.
fn painted(ask: Ask<Vector, Option<Vector>>) -> StandIn {
    StandIn::painted([31, 17], move |[x, y]| {
        let [right, up] = [(f64::from(x) - 15.0) / 15.0, (8.0 - f64::from(y)) / 15.0];
        let direction = ask.once([right, up, -1.0].map(|part| 1.7e308 * part)).flatten();
        direction.map_or([0.0; 3], |direction| direction.map(|part| 0.5 + 0.5 * part))
    })
}
