//! Chapter 19: a direction off a mirror whose normal may be of any length.

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::follow::{Scattered, specular_stage};
use pinhole::intersect::Surfaces;
use pinhole::material::{MirrorTable, mirror_direction};
use pinhole::plan::{Column, VectorRowsMut};
use pinhole::rays::WorldRays;
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Probe, Question, RowPlaces, Setting, Shown, StandIn, probes};
use pinhole_lab::measure::draws::Draws;

type Vector = [f64; 3];

/// A direction and a normal.
type Input = (Vector, Vector);

/// What the reader writes.
pub type Yours = fn(Vector, Vector) -> Vector;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("mirrored", question, move |&(direction, normal)| yours(direction, normal), mine)
}

fn question() -> Question<Input, Vector> {
    Question {
        pinhole_has: ("src/pinhole/material/fresnel.rs", "mirror_direction"),
        probes: asked(),
        tell: |(direction, normal)| format!("direction {}, normal {}", direction.shown(), normal.shown()),
        right: |input| mirror_direction(input.0.into(), unit(input)).into(),
        apart: |yours, right| absolute(yours, right),
        allowed: 1e-12,
        measured: "in a part",
        mistakes: Mistakes::<Input, Vector>::new()
.say("only the component along which the normal is longest is turned round; the normal may point anywhere")
.when(|&(mut direction, normal)| {
    let most = normal.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
    let at = normal.iter().position(|part| part.abs() == most).unwrap_or(0);
    direction[at] = -direction[at];
    direction
})
.say("it is the normal that comes out; the direction is to be turned round along it")
.when(|input| unit(input).into())
.say("a cross product stands at a right angle to both; what comes out lies in the plane of direction and normal")
.when(|input| DVec3::from(input.0).cross(unit(input)).normalize_or_zero().into())
.when(|input| unit(input).cross(input.0.into()).normalize_or_zero().into())
            .say("the normal is taken for a unit vector: divide by n · n")
            .when(|input| turned(input, -2.0, 0))
            .say(
                "what comes out is divided by the normal's length once, but n is in the formula twice: divide by n \
                 · n",
            )
            .when(|input| turned(input, -2.0, 1))
            .say("the normal's length is divided out too often: n is in the formula twice, so divide by n · n")
            .when(|input| turned(input, -2.0, 3))
            .when(|input| turned(input, -2.0, 4))
            .say("the result is normalised instead of the normal; that does not undo the normal's length")
            .when(|input| DVec3::from(turned(input, -2.0, 0)).normalize().into())
            .say("what comes out goes into the mirror: it is d − 2 (d · n) n, not 2 (d · n) n − d")
            .when(|input| negative(turned(input, -2.0, 2)))
            .when(|input| negative(turned(input, -2.0, 0)))
            .say("the 2 is missing: the part along the normal is taken off, and not turned round")
            .when(|input| turned(input, -1.0, 2))
            .when(|input| turned(input, -1.0, 0))
            .say(
                "the 2 is missing, and normalising does not replace it: the part along the normal must be turned \
                 round",
            )
            .when(|input| {
                let along_the_mirror = DVec3::from(turned(input, -1.0, 2));
                (along_the_mirror / along_the_mirror.length()).into()
            })
            .say("the part along the normal is taken off four times; twice turns it round")
            .when(|input| turned(input, -4.0, 2))
            .say("the part along the normal is added; it is taken off twice: d − 2 (d · n) n")
            .when(|input| turned(input, 2.0, 2))
            .when(|input| turned(input, 2.0, 0))
            .say("d · n is missing: the normal is to be multiplied by the length of the part along it")
            .when(|input| (DVec3::from(input.0) + 2.0 * unit(input)).into())
            .when(|input| (DVec3::from(input.0) - 2.0 * unit(input)).into())
            .when(|input| (DVec3::from(input.0) + unit(input)).normalize().into())
            .when(|input| (DVec3::from(input.0) - unit(input)).normalize().into())
            .say("the signs are mixed: it is d − 2 (d · n) n, with d in both places")
            .when(|input| negative(turned(input, 2.0, 2)))
            .say("the direction is sent back where it came from")
            .when(|input| negative(input.0))
            .say("the direction goes on through the mirror as it came")
            .when(|input| input.0)
            .say("only y is turned round; the normal may point anywhere")
            .when(|&([x, y, z], _)| [x, -y, z])
            .say("from behind a mirror works too; no sign of d · n needs to be asked for")
            .when(|input| if facing(input) > 0.0 { turned(input, 2.0, 2) } else { turned(input, -2.0, 2) })
            .when(|input| if facing(input) > 0.0 { input.0 } else { turned(input, -2.0, 2) })
            .when(|input| if facing(input) > 0.0 { [0.0; 3] } else { turned(input, -2.0, 2) })
            .say("the absolute value of d · n is taken off; the sign of d · n must stay")
            .when(|input| if facing(input) > 0.0 { turned(input, -2.0, 2) } else { turned(input, 2.0, 2) }),
        hints: &[
            "split the direction into a part along the normal and a part along the surface; a mirror turns one of them \
             round",
            "the part along a unit normal n is (d · n) n; take it off twice",
            "and where n has another length: by what must (d · n) n be divided to stay the same part?",
        ],
    }
}

fn unit(input: &Input) -> DVec3 {
    DVec3::from(input.1).normalize()
}

fn facing(&(direction, normal): &Input) -> f64 {
    DVec3::from(direction).dot(normal.into())
}

fn negative(direction: Vector) -> Vector {
    direction.map(|part| -part)
}

/// d + factor (d · n) n over a power of the normal's length.
fn turned(input: &Input, factor: f64, power: i32) -> Vector {
    let (direction, normal) = (DVec3::from(input.0), DVec3::from(input.1));
    (direction + factor * facing(input) / normal.length().powi(power) * normal).into()
}

fn asked() -> Vec<Probe<Input>> {
    let anywhere = |seed, size: f64| {
        (0..20).map(move |at| {
            let mut draws = Draws::new(seed, at);
            let normal = draws.unit_vector() * draws.power_of_ten(-size, size);
            (draws.unit_vector().to_array(), normal.to_array())
        })
    };
    let up = [0.0, 1.0, 0.0];
    let mut asked: Vec<_> = probes("at normal incidence", [([0.0, -1.0, 0.0], up)]).collect();
    asked.extend(probes("at 3, 4 and 5", [([0.6, -0.8, 0.0], up), ([0.0, -0.8, -0.6], up)]));
    asked.extend(probes("along the mirror", [([1.0, 0.0, 0.0], up)]));
    asked.extend(probes("anywhere, a normal of length 1", anywhere(1911, 0.0)));
    asked.extend(probes("from behind", [([0.6, 0.8, 0.0], up)]));
    asked.extend(probes("a normal of another length", [([0.6, -0.8, 0.0], [0.0, 2.0, 0.0])]));
    asked.extend(probes("a normal of another length", anywhere(1912, 6.0)));
    asked
}

/// Directions in which light goes on from mirrors.
fn mine(ask: Ask<Input, Vector>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        specular_stage::<MirrorTable>,
        move |mut tiles: Query<(RowPlaces, &WorldRays, &Surfaces, &mut Scattered)>| {
            for (place, rays, surfaces, mut scattered) in &mut tiles {
                // Rough metal has a pdf, a mirror has none.
                for ray in (0..scattered.rows()).filter(|&ray| scattered.pdf[ray] == f64::INFINITY).collect::<Vec<_>>()
                {
                    let row = scattered.row[ray] as usize;
                    // A normal may have any length, and be on either side.
                    let normal = -2.0 * surfaces.get(row).normal.as_dvec3();
                    if let Some(direction) = ask.at(place, row, (rays.direction_of(row).into(), normal.into())) {
                        let direction = DVec3::from(direction).as_vec3();
                        scattered.direction.put(ray, direction);
                    }
                }
            }
        },
    )
}
