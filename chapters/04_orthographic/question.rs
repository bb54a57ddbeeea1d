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

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::orthographic_ray)
}

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
        right: |&(screen, view_height)| ray(screen, view_height / 2.0),
        apart: |yours, right| relative(&yours.0, &right.0).max(relative(&yours.1, &right.1)),
        allowed: 1e-15,
        measured: "of a part",
        mistakes: vec![
            Mistake::new(
                "the origin is twice as far out: screen y runs from −1 to 1, which is 2 high",
                |&(screen, h)| ray(screen, h),
            ),
            Mistake::new("the view's height is left out", |&(screen, _)| ray(screen, 1.0)),
            Mistake::new("the direction is +z; the camera looks down −z", |&(screen, h)| {
                (ray(screen, h / 2.0).0, [0.0, 0.0, 1.0])
            }),
            Mistake::new("the rays start at one point and spread; here they start apart and are parallel", |input| {
                let &(screen, h) = input;
                let [x, y, _] = ray(screen, h / 2.0).0;
                let length = (x * x + y * y + 1.0).sqrt();
                ([0.0; 3], [x / length, y / length, -1.0 / length])
            }),
            Mistake::new("y points down; on the screen and in camera space it points up", |&(screen, h)| {
                ray([screen[0], -screen[1]], h / 2.0)
            }),
            Mistake::new("the rectangle stands at z = −1; here it stands at z = 0", |&(screen, h)| {
                let (origin, direction) = ray(screen, h / 2.0);
                ([origin[0], origin[1], -1.0], direction)
            }),
        ],
        hints: &[
            "all rays have the same direction; only the origin depends on the screen point",
            "the upper edge of the image is screen y = 1, and in the view it is half the height above the centre",
            "origin: x and y of the screen point, each times view_height / 2, and z = 0; direction: (0, 0, −1)",
        ],
    }
}

fn ray(screen: [f64; 2], half_height: f64) -> Ray {
    (camera_ray_orthographic(screen.into(), half_height).into(), [0.0, 0.0, -1.0])
}
