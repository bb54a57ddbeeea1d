//! Chapter 05: the direction from the eye through a screen point.

use super::mine::mine;
use pinhole::extract::tan_half;
use pinhole::rays::camera_ray_perspective;
use pinhole::scene::Degrees;
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{Exercise, Mistake, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;

pub(super) type Input = ([f64; 2], f64);

/// What the reader writes.
pub type Yours = fn([f64; 2], f64) -> [f64; 3];

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::perspective_direction)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("perspective_direction", question, move |&(screen, tangent)| yours(screen, tangent), mine)
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
        mistakes: vec![
            Mistake::new("the direction is not of length 1", |&(screen, tangent)| through(screen, tangent, tangent)),
            Mistake::new("the tangent is left out", |&(screen, _)| unit(through(screen, 1.0, 1.0))),
            Mistake::new("only y is scaled by the tangent; x is in half heights too", |&(screen, tangent)| {
                unit(through(screen, 1.0, tangent))
            }),
            Mistake::new("the image plane stands at z = +1; the camera looks down −z", |&(screen, tangent)| {
                let [x, y, z] = unit(through(screen, tangent, tangent));
                [x, y, -z]
            }),
            Mistake::new("x and y are turned about, as on the film of a box with a hole", |&([x, y], tangent)| {
                unit(through([-x, -y], tangent, tangent))
            }),
            Mistake::new("y points down; on the screen and in camera space it points up", |&([x, y], tangent)| {
                unit(through([x, -y], tangent, tangent))
            }),
            Mistake::new("a tangent is taken of the tangent, which is one already", |&(screen, tangent)| {
                let twice = libm::tan(tangent);
                unit(through(screen, twice, twice))
            }),
        ],
        hints: &[
            "the eye is the origin: the direction is the point of the image plane itself, brought to length 1",
            "half the plane's height is the tangent; screen y = 1 is its upper edge, and x has the same unit",
            "the point is (x · tan, y · tan, −1); divide each part by √(its x² + its y² + 1)",
        ],
    }
}

fn through([x, y]: [f64; 2], across: f64, up: f64) -> [f64; 3] {
    [x * across, y * up, -1.0]
}

fn unit([x, y, z]: [f64; 3]) -> [f64; 3] {
    let length = (x * x + y * y + z * z).sqrt();
    [x / length, y / length, z / length]
}
