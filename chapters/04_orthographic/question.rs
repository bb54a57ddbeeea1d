//! Chapter 04: the ray that starts at a point of the view rectangle.

use super::mine::mine;
use pinhole::rays::camera_ray_orthographic;
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{Exercise, Mistake, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;

pub(super) type Input = ([f64; 2], f64);
pub(super) type Ray = ([f64; 3], [f64; 3]);

/// What the reader writes.
pub type Yours = fn([f64; 2], f64) -> Ray;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("orthographic_ray", question, move |&(screen, view_height)| yours(screen, view_height), mine)
}

fn question() -> Question<Input, Ray> {
    let at = |seed, widest: f64, low, high| {
        (0..30).map(move |index| {
            let mut draws = Draws::new(seed, index);
            let screen = [draws.between(-widest, widest), draws.between(-1.0, 1.0)];
            (screen, draws.power_of_ten(low, high))
        })
    };
    let corners = [[0.0, 0.0], [1.0, 1.0], [-1.5, 1.0], [1.5, -1.0], [0.0, -1.0]];
    let mut asked: Vec<_> =
        probes("a corner or the centre, a view 3 high", corners.map(|screen| (screen, 3.0))).collect();
    asked.extend(probes("anywhere in an ordinary view", at(401, 1.78, -1.0, 2.0)));
    asked.extend(probes("an image 10000 times as wide as high", at(402, 1e4, -1.0, 2.0)));
    asked.extend(probes("a view as small as an atom, or smaller", at(403, 1.0, -18.0, -10.0)));
    asked.extend(probes("a view as large as a galaxy, in millimetres", at(404, 1.0, 10.0, 18.0)));
    Question {
        pinhole_has: ("src/pinhole/cameras/orthographic.rs", "camera_ray_orthographic"),
        probes: asked,
        tell: |(screen, view_height)| format!("screen {}, view_height {view_height:?}", screen.shown()),
        right,
        apart: |yours, right| relative(&yours.0, &right.0).max(relative(&yours.1, &right.1)),
        allowed: 1e-15,
        measured: "of a part",
        mistakes: vec![
            Mistake::new(
                "the origin is twice as far out: screen y runs from −1 to 1, which is 2 high",
                |&(screen, h)| ray(screen, h),
            ),
            Mistake::new("the origin is half as far out: only one half belongs to the height", |&(screen, h)| {
                ray(screen, h / 4.0)
            }),
            Mistake::new("the view's height is left out", |&(screen, _)| ray(screen, 1.0)),
            Mistake::new("the view's height is left out", |&(screen, _)| ray(screen, 0.5)),
            Mistake::new(
                "the screen point is divided by the height; a higher view spreads the rays",
                |&(screen, h)| ray(screen, 1.0 / h),
            ),
            Mistake::new(
                "the screen point is divided by the height; a higher view spreads the rays",
                |&(screen, h)| ray(screen, 2.0 / h),
            ),
            Mistake::new("only y is scaled by half the height; x is in the same unit", |&([x, y], h)| {
                ray([x / h * 2.0, y], h / 2.0)
            }),
            Mistake::new("only x is scaled by half the height; y is in the same unit", |&([x, y], h)| {
                ray([x, y / h * 2.0], h / 2.0)
            }),
            Mistake::new(
                "x is scaled by the whole height and y by half of it; both have the same unit",
                |&([x, y], h)| ray([2.0 * x, y], h / 2.0),
            ),
            Mistake::new(WIDE, |&([x, y], h)| ray([x * (480.0 / 270.0), y], h / 2.0)),
            Mistake::new(WIDE, |&([x, y], h)| ray([x / (480.0 / 270.0), y], h / 2.0)),
            Mistake::new(CORNER, |&([x, y], h)| ([x * h - h / 2.0, y * h - h / 2.0, 0.0], AHEAD)),
            Mistake::new(CORNER, |&([x, y], h)| ray([(x + 1.0) / 2.0, (y + 1.0) / 2.0], h)),
            Mistake::new(CORNER, |&([x, y], h)| ray([x - 1.0, y - 1.0], h / 2.0)),
            Mistake::new("the direction is +z; the camera looks down −z", |i| with(right(i), |(_, d)| d[2] = 1.0)),
            Mistake::new("the direction points up; the camera looks down −z", |i| {
                with(right(i), |(_, d)| *d = [0.0, 1.0, 0.0])
            }),
            Mistake::new("the direction is not of length 1", |i| with(right(i), |(_, d)| d[2] = -i.1)),
            Mistake::new(SPREAD, |i| with(spread(i, true), |(o, _)| *o = [0.0; 3])),
            Mistake::new(SPREAD, |i| with(spread(i, false), |(o, _)| *o = [0.0; 3])),
            Mistake::new(SPREADING, |i| spread(i, true)),
            Mistake::new(SPREADING, |i| spread(i, false)),
            Mistake::new(SPREADING, |i| with(spread(i, true), |(o, _)| o[2] = -1.0)),
            Mistake::new("the rays all start at one point; here they start apart", |_| ([0.0; 3], AHEAD)),
            Mistake::new("y points down; on the screen and in camera space it points up", |&([x, y], h)| {
                ray([x, -y], h / 2.0)
            }),
            Mistake::new("x points left; on the screen and in camera space it points right", |&([x, y], h)| {
                ray([-x, y], h / 2.0)
            }),
            Mistake::new("x and y are turned about; nothing crosses over without a hole", |&([x, y], h)| {
                ray([-x, -y], h / 2.0)
            }),
            Mistake::new("x and y are swapped", |&([x, y], h)| ray([y, x], h / 2.0)),
            Mistake::new("the rectangle stands at z = −1; here it stands at z = 0", |i| {
                with(right(i), |(o, _)| o[2] = -1.0)
            }),
            Mistake::new("the rectangle stands at z = 1; here it stands at z = 0", |i| {
                with(right(i), |(o, _)| o[2] = 1.0)
            }),
            Mistake::new("origin and direction are swapped", |i| (right(i).1, right(i).0)),
            Mistake::new(
                "y is scaled by the whole height and x by half of it; both have the same unit",
                |&([x, y], h)| ray([x, 2.0 * y], h / 2.0),
            ),
            Mistake::new(
                "y is counted from the upper edge; the screen has its centre at the origin",
                |&([x, y], h)| ray([x, 1.0 - y], h / 2.0),
            ),
            Mistake::new(ANGLE, |&(screen, h)| ray(screen, libm::tan(h / 2.0))),
            Mistake::new(ANGLE, |&(screen, h)| ray(screen, libm::tan(h.to_radians() / 2.0))),
            Mistake::new("the direction is not of length 1", |i| with(right(i), |(_, d)| d[2] = -i.1 / 2.0)),
            Mistake::new("the rectangle stands half a height in front of the camera; here it stands at z = 0", |i| {
                with(right(i), |(o, _)| o[2] = -i.1 / 2.0)
            }),
            Mistake::new("the rectangle stands a height in front of the camera; here it stands at z = 0", |i| {
                with(right(i), |(o, _)| o[2] = -i.1)
            }),
            Mistake::new("the direction leads along y; the camera looks down −z", |i| {
                with(right(i), |(_, d)| *d = [0.0, -1.0, 0.0])
            }),
            Mistake::new(SPREADING, |i| with(spread(i, true), |(o, d)| (d[0], d[1], o[2]) = (-d[0], -d[1], 0.0))),
            Mistake::new(SPREAD, |&(screen, _)| with(spread(&(screen, 2.0), true), |(o, _)| *o = [0.0; 3])),
            Mistake::new(SPREAD, |&(screen, _)| with(spread(&(screen, 2.0), false), |(o, _)| *o = [0.0; 3])),
            Mistake::new(SPREADING, |i| (right(i).0, spread(&(i.0, 2.0), true).1)),
            Mistake::new(SPREADING, |i| (right(i).0, spread(&(i.0, 2.0), false).1)),
            Mistake::new(
                "the screen point is taken to run from 0 to 1 with y down; its origin is the centre, and y points up",
                |&([x, y], h)| ray([2.0 * x - 1.0, 1.0 - 2.0 * y], h / 2.0),
            ),
        ],
        hints: &[
            "all rays have the same direction; only the origin depends on the screen point",
            "the upper edge of the image is screen y = 1, and in the view it is half the height above the centre",
            "origin: x and y of the screen point, each times view_height / 2, and z = 0; direction: (0, 0, −1)",
        ],
    }
}

fn ray(screen: [f64; 2], half_height: f64) -> Ray {
    (camera_ray_orthographic(screen.into(), half_height).into(), AHEAD)
}

const AHEAD: [f64; 3] = [0.0, 0.0, -1.0];
const WIDE: &str = "the aspect is put into x once more; the screen's x has it already, in half heights as y is";
const CORNER: &str =
    "the screen point is counted from a corner; the screen has its centre at the origin, as the view has";
const SPREAD: &str = "the rays start at one point and spread; here they start apart and are parallel";
const SPREADING: &str = "the rays start apart but spread, too: all of them have the direction (0, 0, −1)";

fn right(&(screen, view_height): &Input) -> Ray {
    ray(screen, view_height / 2.0)
}

fn with(mut ray: Ray, change: impl Fn(&mut Ray)) -> Ray {
    change(&mut ray);
    ray
}

/// The ray whose direction leads from the eye through its place on a rectangle at z = −1.
fn spread(input: &Input, unit: bool) -> Ray {
    let [x, y, _] = right(input).0;
    let length = if unit { (x * x + y * y + 1.0).sqrt() } else { 1.0 };
    ([x, y, 0.0], [x / length, y / length, -1.0 / length])
}

const ANGLE: &str = "the height is taken for an angle; it is a length in scene units";
