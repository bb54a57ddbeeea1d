//! Chapter 05: the direction from the eye through a screen point.

use bevy_ecs::prelude::*;
use pinhole::extract::{PerspectiveProjection, tan_half};
use pinhole::plan::{Column, Shared, VectorRows, VectorRowsMut};
use pinhole::rays;
use pinhole::rays::{CameraRays, ScreenPoints, camera_ray_perspective};
use pinhole::scene::Degrees;
use pinhole::scene::View;
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Question, RowPlaces, Setting, Shown, StandIn, on_camera, probes,
};
use pinhole_lab::measure::draws::Draws;

type Input = ([f64; 2], f64);

/// What the reader writes.
pub type Yours = fn([f64; 2], f64) -> [f64; 3];

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("perspective_direction", question, move |&(screen, tangent)| yours(screen, tangent), mine)
        .and_in("the directions themselves", |world| on_camera(world, View { column: "camera".into() }))
}

fn question() -> Question<Input, [f64; 3]> {
    let at = |seed, widest: f64, low: f64, high: f64| {
        (0..30).map(move |index| {
            let mut draws = Draws::new(seed, index);
            let screen = [draws.between(-widest, widest), draws.between(-1.0, 1.0)];
            (screen, tan_half(Degrees(draws.between(low, high))))
        })
    };
    let right_angle = tan_half(Degrees(90.0));
    let mut asked: Vec<_> = probes("the centre of the image", [([0.0, 0.0], 0.5)]).collect();
    asked.extend(probes("an edge, at a vertical angle of 90°", [[0.0, 1.0], [-1.0, 0.0]].map(|s| (s, right_angle))));
    asked.extend(probes("a corner of 480 × 270", [[16.0 / 9.0, 1.0], [-16.0 / 9.0, -1.0]].map(|s| (s, 0.364))));
    asked.extend(probes("an ordinary angle", at(501, 1.78, 10.0, 120.0)));
    asked.extend(probes("a wide angle, close to 180°", at(502, 1.78, 170.0, 179.99)));
    asked.extend(probes("the widest angles, above 179.99°", at(503, 1.0, 179.99, 179.999_999)));
    asked.extend(probes("a narrow angle, below 0.001°", at(504, 1.78, 1e-6, 1e-3)));
    asked.extend(probes("an image 10000 times as wide as high", at(505, 1e4, 10.0, 120.0)));
    Question {
        pinhole_has: ("src/pinhole/cameras/perspective.rs", "camera_ray_perspective"),
        probes: asked,
        tell: |(screen, tangent)| format!("screen {}, tan_half_vertical {tangent:?}", screen.shown()),
        right: |&(screen, tangent)| camera_ray_perspective(screen.into(), tangent).into(),
        apart: |yours, right| relative(yours, right),
        allowed: 2e-15,
        measured: "of a part",
        mistakes: mistakes(),
        hints: &[
            "the eye is the origin: the direction is the point of the image plane itself, brought to length 1",
            "half the plane's height is the tangent; screen y = 1 is its upper edge, and x has the same unit",
            "the plane is at distance 1 in front of the eye: write down the point's three coordinates, and then what \
             brings them to length 1",
        ],
    }
}

fn mistakes() -> Mistakes<Input, [f64; 3]> {
    let x = Part::<Input, f64>::new(|i| i.0[0])
        .say("only y is scaled by the tangent; x is in half heights too")
        .when(|i| i.0[0] / i.1)
        .say(TURNED)
        .when(|i| -i.0[0])
        .say("x points left; on the screen and in camera space it points right")
        .when(|i| -i.0[0])
        .say("the aspect is put into x once more; the screen's x has it already, in half heights as y is")
        .when(|i| i.0[0] * (480.0 / 270.0))
        .when(|i| i.0[0] / (480.0 / 270.0))
        .say(CORNER)
        .when(|i| i.0[0] - 1.0)
        .say("x and y are swapped")
        .when(|i| i.0[1]);
    let y = Part::<Input, f64>::new(|i| i.0[1])
        .say("only x is scaled by the tangent; y is in half heights too")
        .when(|i| i.0[1] / i.1)
        .say("y points down; on the screen and in camera space it points up")
        .when(|i| -i.0[1])
        .say(TURNED)
        .when(|i| -i.0[1])
        .say(CORNER)
        .when(|i| i.0[1] - 1.0)
        .say("x and y are swapped")
        .when(|i| i.0[0]);
    let tangent = Part::<Input, f64>::new(|i| i.1)
        .say("the tangent is left out, or multiplies z as well, and then it changes no direction")
        .when(|_| 1.0)
        .say(
            "the tangent is the plane's distance, or divides x and y: the wider the angle, the wider the rays \
                 must spread",
        )
        .when(|i| 1.0 / i.1)
        .say("the tangent is halved; it is that of half the angle already")
        .when(|i| i.1 / 2.0)
        .say("the tangent is doubled; screen y = 1 is half the height away from the centre")
        .when(|i| 2.0 * i.1)
        .say("a tangent is taken of the tangent, which is one already")
        .when(|i| libm::tan(i.1))
        .when(|i| libm::tan(i.1 / 2.0))
        .when(|i| libm::tan(i.1.to_radians()))
        .when(|i| libm::tan((i.1 / 2.0).to_radians()))
        .say("the tangent is turned back into an angle; the plane's height is asked for")
        .when(|i| libm::atan(i.1))
        .say("the tangent is a factor twice; x and y are scaled by it once")
        .when(|i| i.1 * i.1);
    let z = Part::<Input, f64>::new(|_| -1.0)
        .say("the image plane stands at z = +1; the camera looks down −z")
        .when(|_| 1.0)
        .say("z is scaled by the tangent, too; the image plane stands at z = −1")
        .when(|i| -i.1);
    let whole = Part::<[f64; 4], [f64; 3]>::new(|v| divided(v, |[x, y, z]| (x * x + y * y + z * z).sqrt()))
        .say("the direction is not of length 1")
        .when(through)
        .say("the direction is divided by its squared length: a square root is missing")
        .when(|v| divided(v, |[x, y, z]| x * x + y * y + z * z))
        .say("the length is that of x and y alone; −1 is a part of the direction, too")
        .when(|v| divided(v, |[x, y, _]| (x * x + y * y).sqrt()))
        .say("1 is taken off under the root: the square of −1 is 1, and it is added")
        .when(|v| divided(v, |[x, y, z]| (x * x + y * y - z * z).sqrt()))
        .say("the length is taken for |x| + |y| + |z|; it is √(x² + y² + z²)")
        .when(|v| divided(v, |[x, y, z]| x.abs() + y.abs() + z.abs()))
        .say("only x and y are divided by the length; z is a part of the direction, too")
        .when(|v| {
            let [x, y, _] = unit(through(v));
            [x, y, v[3]]
        })
        .say("the direction is brought to length 1 before the tangent widens it; length 1 comes last")
        .when(|&[x, y, tangent, z]| {
            let [x, y, z] = unit([x, y, z]);
            [x * tangent, y * tangent, z]
        })
        .when(|&[x, y, tangent, z]| unit([x, y, z]).map(|part| part * tangent))
        .say("the direction leads from the screen point to the eye; the opposite is meant")
        .when(|v| unit(through(v)).map(|part| -part));
    Mistakes::<Input, [f64; 3]>::new()
        .say("angles are taken to be in proportion to the screen; on a plane their tangents are")
        .when(|&([x, y], t)| unit([libm::tan(x * libm::atan(t)), libm::tan(y * libm::atan(t)), -1.0]))
        .when(|&(screen, t)| {
            let [x, y] = screen.map(|part| part * libm::atan(t));
            [libm::sin(x) * libm::cos(y), libm::sin(y), -libm::cos(x) * libm::cos(y)]
        })
        .of_parts([x, y, tangent, z], whole)
}

fn unit([x, y, z]: [f64; 3]) -> [f64; 3] {
    let length = (x * x + y * y + z * z).sqrt();
    [x / length, y / length, z / length]
}

/// The point of the image plane.
fn through(&[x, y, tangent, z]: &[f64; 4]) -> [f64; 3] {
    [x * tangent, y * tangent, z]
}

fn divided(of: &[f64; 4], by: fn([f64; 3]) -> f64) -> [f64; 3] {
    through(of).map(|part| part / by(through(of)))
}

const TURNED: &str = "x and y have the opposite signs, as on the film of a box with a hole";

const CORNER: &str = "the screen point is counted from a corner; the screen has its centre at the origin";

/// Directions of camera rays.
fn mine(ask: Ask<Input, [f64; 3]>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        rays::perspective_stage,
        move |camera: Res<Shared<PerspectiveProjection>>,
              mut tiles: Query<(RowPlaces, &ScreenPoints, &mut CameraRays)>| {
            for (place, screen, mut rays) in &mut tiles {
                for row in 0..screen.rows() {
                    let asked = (screen.point.at(row), camera.tan_half_vertical);
                    if let Some(direction) = ask.at(place, row, asked) {
                        rays.direction.put(row, direction);
                    }
                }
            }
        },
    )
}
