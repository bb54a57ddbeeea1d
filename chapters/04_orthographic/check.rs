//! Chapter 04: the ray that starts at a point of the view rectangle.

use bevy_ecs::prelude::*;
use pinhole::extract::OrthographicWindow;
use pinhole::plan::{Column, Shared, VectorRows, VectorRowsMut};
use pinhole::rays;
use pinhole::rays::{CameraRays, ScreenPoints, camera_ray_orthographic};
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Part, Question, RowPlaces, Setting, Shown, StandIn, probes};
use pinhole_lab::measure::draws::Draws;

type Input = ([f64; 2], f64);

type Ray = ([f64; 3], [f64; 3]);

/// What the reader writes.
pub type Yours = fn([f64; 2], f64) -> Ray;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("orthographic_ray", question, move |&(screen, view_height)| yours(screen, view_height), mine)
}

fn question() -> Question<Input, Ray> {
    let drawn = |seed, widest: f64, low, high| {
        (0..30).map(move |index| {
            let mut draws = Draws::new(seed, index);
            let screen = [draws.between(-widest, widest), draws.between(-1.0, 1.0)];
            (screen, draws.power_of_ten(low, high))
        })
    };
    let corners = [[0.0, 0.0], [1.0, 1.0], [-1.5, 1.0], [1.5, -1.0], [0.0, -1.0]];
    let mut asked: Vec<_> =
        probes("a corner or the centre, a view 3 high", corners.map(|screen| (screen, 3.0))).collect();
    asked.extend(probes("anywhere in an ordinary view", drawn(401, 1.78, -1.0, 2.0)));
    asked.extend(probes("an image 10000 times as wide as high", drawn(402, 1e4, -1.0, 2.0)));
    asked.extend(probes("a view as small as an atom, or smaller", drawn(403, 1.0, -18.0, -10.0)));
    asked.extend(probes("a view as large as a galaxy, in millimetres", drawn(404, 1.0, 10.0, 18.0)));
    Question {
        pinhole_has: ("src/pinhole/cameras/orthographic.rs", "camera_ray_orthographic"),
        probes: asked,
        tell: |(screen, view_height)| format!("screen {}, view_height {view_height:?}", screen.shown()),
        right,
        apart: |yours, right| relative(&yours.0, &right.0).max(relative(&yours.1, &right.1)),
        allowed: 1e-15,
        measured: "of a part",
        mistakes: mistakes(),
        hints: &[
            "all rays have the same direction; only the origin depends on the screen point",
            "the upper edge of the image is screen y = 1, and in the view it is half the height above the centre",
            "x and y have the same unit, so one factor takes both from the screen to the scene; and along which axis \
             does the camera look?",
        ],
    }
}

fn mistakes() -> Mistakes<Input, Ray> {
    let origin = Part::<Input, [f64; 3]>::new(|i| right(i).0)
        .say("the origin is twice as far out: screen y runs from −1 to 1, which is 2 high")
        .when(|&(screen, h)| at(screen, h))
        .say("the origin is half as far out: only one half belongs to the height")
        .when(|&(screen, h)| at(screen, h / 4.0))
        .say("the view's height is left out")
        .when(|&(screen, _)| at(screen, 1.0))
        .when(|&(screen, _)| at(screen, 0.5))
        .say("the screen point is divided by the height; a higher view spreads the rays")
        .when(|&(screen, h)| at(screen, 1.0 / h))
        .when(|&(screen, h)| at(screen, 2.0 / h))
        .say("only y is scaled by half the height; x is in the same unit")
        .when(|&([x, y], h)| [x, y * h / 2.0, 0.0])
        .say("only x is scaled by half the height; y is in the same unit")
        .when(|&([x, y], h)| [x * h / 2.0, y, 0.0])
        .say("x is scaled by the whole height and y by half of it; both have the same unit")
        .when(|&([x, y], h)| [x * h, y * h / 2.0, 0.0])
        .say("y is scaled by the whole height and x by half of it; both have the same unit")
        .when(|&([x, y], h)| [x * h / 2.0, y * h, 0.0])
        .say("the aspect is put into x once more; the screen's x has it already, in half heights as y is")
        .when(|&([x, y], h)| at([x * (480.0 / 270.0), y], h / 2.0))
        .when(|&([x, y], h)| at([x / (480.0 / 270.0), y], h / 2.0))
        .say("the screen point is counted from a corner; the screen has its centre at the origin, as the view has")
        .when(|&([x, y], h)| [x * h - h / 2.0, y * h - h / 2.0, 0.0])
        .when(|&([x, y], h)| at([(x + 1.0) / 2.0, (y + 1.0) / 2.0], h))
        .when(|&([x, y], h)| at([x - 1.0, y - 1.0], h / 2.0))
        .say("y is counted from the upper edge; the screen has its centre at the origin")
        .when(|&([x, y], h)| at([x, 1.0 - y], h / 2.0))
        .say("the screen point is taken to run from 0 to 1 with y down; its origin is the centre, and y points up")
        .when(|&([x, y], h)| at([2.0 * x - 1.0, 1.0 - 2.0 * y], h / 2.0))
        .say("the rays all start at one point; here they start apart")
        .when(|_| [0.0; 3])
        .say("y points down; on the screen and in camera space it points up")
        .when(|&([x, y], h)| at([x, -y], h / 2.0))
        .say("x points left; on the screen and in camera space it points right")
        .when(|&([x, y], h)| at([-x, y], h / 2.0))
        .say("x and y have the opposite signs; nothing crosses over without a hole")
        .when(|&([x, y], h)| at([-x, -y], h / 2.0))
        .say("x and y are swapped")
        .when(|&([x, y], h)| at([y, x], h / 2.0))
        .say("the height is taken for an angle; it is a length in scene units")
        .when(|&(screen, h)| at(screen, libm::tan(h / 2.0)))
        .when(|&(screen, h)| at(screen, libm::tan(h.to_radians() / 2.0)))
        .say("the rectangle stands at z = −1; here it stands at z = 0")
        .when(|i| standing(i, -1.0))
        .say("the rectangle stands at z = 1; here it stands at z = 0")
        .when(|i| standing(i, 1.0))
        .say("the rectangle stands half a height in front of the camera; here it stands at z = 0")
        .when(|i| standing(i, -i.1 / 2.0))
        .say("the rectangle stands a height in front of the camera; here it stands at z = 0")
        .when(|i| standing(i, -i.1));
    let direction = Part::<Input, [f64; 3]>::new(|_| AHEAD)
        .say("the direction is +z; the camera looks down −z")
        .when(|_| [0.0, 0.0, 1.0])
        .say("the direction points up; the camera looks down −z")
        .when(|_| [0.0, 1.0, 0.0])
        .say("the direction leads along y; the camera looks down −z")
        .when(|_| [0.0, -1.0, 0.0])
        .say("the direction is not of length 1")
        .when(|i| [0.0, 0.0, -i.1])
        .when(|i| [0.0, 0.0, -i.1 / 2.0])
        .say("the rays spread; here they are parallel: all of them have the direction (0, 0, −1)")
        .when(|i| spread(right(i).0, true))
        .when(|i| spread(right(i).0, false))
        .when(|i| spread(at(i.0, 1.0), true))
        .when(|i| spread(at(i.0, 1.0), false))
        .when(|i| spread(right(i).0.map(|part| -part), true));
    let whole = Part::<[[f64; 3]; 2], Ray>::new(|&[origin, direction]| (origin, direction))
        .say("origin and direction are swapped")
        .when(|&[origin, direction]| (direction, origin));
    Mistakes::<Input, Ray>::new()
        .say("the direction is that from the centre to the place on the rectangle; all rays go straight ahead")
        .when(|i| {
            let (at, _) = right(i);
            let length = (at[0] * at[0] + at[1] * at[1]).sqrt();
            (at, at.map(|part| part / length))
        })
        .say("half the height is added to the screen point; it is to be multiplied by it")
        .when(|&([x, y], height)| ([x + height / 2.0, y + height / 2.0, 0.0], AHEAD))
        .of_parts([origin, direction], whole)
}

/// The place on the rectangle.
fn at(screen: [f64; 2], half_height: f64) -> [f64; 3] {
    camera_ray_orthographic(screen.into(), half_height).into()
}

const AHEAD: [f64; 3] = [0.0, 0.0, -1.0];

fn right(&(screen, view_height): &Input) -> Ray {
    (at(screen, view_height / 2.0), AHEAD)
}

/// The right origin at another z.
fn standing(input: &Input, z: f64) -> [f64; 3] {
    let ([x, y, _], _) = right(input);
    [x, y, z]
}

/// The direction from the eye through this place on a rectangle at z = −1.
fn spread([x, y, _]: [f64; 3], unit: bool) -> [f64; 3] {
    let length = if unit { (x * x + y * y + 1.0).sqrt() } else { 1.0 };
    [x / length, y / length, -1.0 / length]
}

/// Origins and directions of camera rays.
fn mine(ask: Ask<Input, Ray>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        rays::orthographic_stage,
        move |view: Res<Shared<OrthographicWindow>>, mut tiles: Query<(RowPlaces, &ScreenPoints, &mut CameraRays)>| {
            for (place, screen, mut rays) in &mut tiles {
                for row in 0..screen.rows() {
                    let asked = (screen.point.at(row), 2.0 * view.half_height);
                    if let Some((origin, direction)) = ask.at(place, row, asked) {
                        rays.origin.put(row, origin);
                        rays.direction.put(row, direction);
                    }
                }
            }
        },
    )
}
