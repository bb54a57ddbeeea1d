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
            Mistake::new("the direction is not of length 1", |&(s, t)| through(s, t, t)),
            Mistake::new("the direction is divided by its squared length: a square root is missing", |&(s, t)| {
                let v = through(s, t, t);
                v.map(|part| part / v.iter().map(|part| part * part).sum::<f64>())
            }),
            Mistake::new("the length is that of x and y alone; −1 is a part of the direction, too", |&(s, t)| {
                let [x, y, z] = through(s, t, t);
                [x, y, z].map(|part| part / (x * x + y * y).sqrt())
            }),
            Mistake::new("the tangent is left out", |&(s, _)| unit(through(s, 1.0, 1.0))),
            Mistake::new("the tangent is left out", |&(s, _)| through(s, 1.0, 1.0)),
            Mistake::new("only y is scaled by the tangent; x is in half heights too", |&(s, t)| {
                unit(through(s, 1.0, t))
            }),
            Mistake::new("only x is scaled by the tangent; y is in half heights too", |&(s, t)| {
                unit(through(s, t, 1.0))
            }),
            Mistake::new(DISTANCE, |&([x, y], t)| unit([x, y, -t])),
            Mistake::new(DISTANCE, |&(s, t)| unit(through(s, 1.0 / t, 1.0 / t))),
            Mistake::new(BEFORE, |&(s, t)| {
                let [x, y, z] = unit(through(s, 1.0, 1.0));
                [x * t, y * t, z]
            }),
            Mistake::new(BEFORE, |&(s, t)| unit(through(s, 1.0, 1.0)).map(|part| part * t)),
            Mistake::new("the tangent is halved; it is that of half the angle already", |&(s, t)| {
                unit(through(s, t / 2.0, t / 2.0))
            }),
            Mistake::new("the tangent is doubled; screen y = 1 is half the height away from the centre", |&(s, t)| {
                unit(through(s, 2.0 * t, 2.0 * t))
            }),
            Mistake::new("the image plane stands at z = +1; the camera looks down −z", |&(s, t)| {
                let [x, y, z] = unit(through(s, t, t));
                [x, y, -z]
            }),
            Mistake::new("the direction leads from the screen point to the eye; the opposite is meant", |&(s, t)| {
                unit(through(s, t, t)).map(|part| -part)
            }),
            Mistake::new("x and y are turned about, as on the film of a box with a hole", |&([x, y], t)| {
                unit(through([-x, -y], t, t))
            }),
            Mistake::new("y points down; on the screen and in camera space it points up", |&([x, y], t)| {
                unit(through([x, -y], t, t))
            }),
            Mistake::new("x points left; on the screen and in camera space it points right", |&([x, y], t)| {
                unit(through([-x, y], t, t))
            }),
            Mistake::new("x and y are swapped", |&([x, y], t)| unit(through([y, x], t, t))),
            Mistake::new(TWICE, |&(s, t)| unit(through(s, libm::tan(t), libm::tan(t)))),
            Mistake::new(TWICE, |&(s, t)| unit(through(s, libm::tan(t / 2.0), libm::tan(t / 2.0)))),
            Mistake::new(TWICE, |&(s, t)| {
                let tangent = libm::tan((t / 2.0).to_radians());
                unit(through(s, tangent, tangent))
            }),
            Mistake::new("the tangent is turned back into an angle; the plane's height is asked for", |&(s, t)| {
                unit(through(s, libm::atan(t), libm::atan(t)))
            }),
            Mistake::new(WIDE, |&([x, y], t)| unit(through([x * (480.0 / 270.0), y], t, t))),
            Mistake::new(WIDE, |&([x, y], t)| unit(through([x / (480.0 / 270.0), y], t, t))),
            Mistake::new("the screen point is counted from a corner; the screen has its centre at the origin", |i| {
                let &([x, y], t) = i;
                unit(through([x - 1.0, y - 1.0], t, t))
            }),
            Mistake::new("the tangent is a factor twice; x and y are scaled by it once", |&(s, t)| {
                unit(through(s, t * t, t * t))
            }),
            Mistake::new("only x and y are divided by the length; z is a part of the direction, too", |&(s, t)| {
                let [x, y, _] = unit(through(s, t, t));
                [x, y, -1.0]
            }),
            Mistake::new("the length is taken for |x| + |y| + |z|; it is √(x² + y² + z²)", |&(s, t)| {
                let v = through(s, t, t);
                v.map(|part| part / v.iter().map(|part| part.abs()).sum::<f64>())
            }),
            Mistake::new(
                "angles are taken to be in proportion to the screen; on a plane their tangents are",
                |&([x, y], t)| {
                    let half = libm::atan(t);
                    unit([libm::tan(x * half), libm::tan(y * half), -1.0])
                },
            ),
            Mistake::new(
                "angles are taken to be in proportion to the screen; on a plane their tangents are",
                |&([x, y], t)| {
                    let [x, y] = [x, y].map(|part| part * libm::atan(t));
                    [libm::sin(x) * libm::cos(y), libm::sin(y), -libm::cos(x) * libm::cos(y)]
                },
            ),
            Mistake::new(TWICE, |&(s, t)| {
                let tangent = libm::tan(t.to_radians());
                unit(through(s, tangent, tangent))
            }),
            Mistake::new("z is scaled by the tangent, too; the image plane stands at z = −1", |&([x, y], t)| {
                unit([x * t, y * t, -t])
            }),
            Mistake::new("1 is taken off under the root: the square of −1 is 1, and it is added", |&(s, t)| {
                let [x, y, z] = through(s, t, t);
                [x, y, z].map(|part| part / (x * x + y * y - 1.0).sqrt())
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

const TWICE: &str = "a tangent is taken of the tangent, which is one already";
const DISTANCE: &str =
    "the tangent is the plane's distance, or divides x and y: the wider the angle, the wider the rays must spread";
const BEFORE: &str = "the direction is brought to length 1 before the tangent widens it; length 1 comes last";
const WIDE: &str = "the aspect is put into x once more; the screen's x has it already, in half heights as y is";
