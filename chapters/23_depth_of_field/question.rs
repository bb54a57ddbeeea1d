//! Chapter 23: the direction from a point of the lens through the point in focus.

use super::mine::mine;
use glam::DVec3;
use pinhole::rays::{camera_ray_lens, camera_ray_perspective};
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;
use pinhole_lab::naive::lens::focus_along_the_ray;

pub(super) type Input = ([f64; 2], f64, [f64; 2], f64);

/// What the reader writes.
pub type Yours = fn([f64; 2], f64, [f64; 2], f64) -> [f64; 3];

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered(
        "lens_direction",
        question,
        move |&(screen, tangent, lens, focus)| yours(screen, tangent, lens, focus),
        mine,
    )
}

fn question() -> Question<Input, [f64; 3]> {
    Question {
        pinhole_has: ("src/pinhole/rays/lens.rs", "camera_ray_lens"),
        probes: asked(),
        tell: |(screen, tangent, lens, focus)| {
            format!(
                "screen {}, tan_half_vertical {tangent:?}, lens {}, focus_distance {focus:?}",
                screen.shown(),
                lens.shown()
            )
        },
        right: |&(screen, tangent, lens, focus)| lens_ray(screen, tangent, lens, focus),
        apart: |yours, right| relative(yours, right),
        allowed: 1e-12,
        measured: "of a part",
        mistakes: vec![
            Mistake::new("the direction is the pinhole's: the lens point is left out", |&(screen, tangent, _, _)| {
                camera_ray_perspective(screen.into(), tangent).into()
            }),
            Mistake::new(
                "the focus is taken along the ray: what is sharp is a sphere about the eye, no plane",
                |input| {
                    let &(screen, tangent, lens, focus) = input;
                    focus_along_the_ray(screen.into(), tangent, lens.into(), focus).into()
                },
            ),
            Mistake::new("the plane in focus is always at distance 1", |&(screen, tangent, lens, _)| {
                lens_ray(screen, tangent, lens, 1.0)
            }),
            Mistake::new(
                "only the depth is multiplied by the focus distance: the point in focus lies on the pinhole's ray, so x \
                 and y are, too",
                |&([x, y], tangent, lens, focus)| lens_ray([x / focus, y / focus], tangent, lens, focus),
            ),
            Mistake::new(
                "only x and y are multiplied by the focus distance: the point in focus lies on the pinhole's ray, at z = −f",
                |input| {
                    let [x, y, _] = not_normalised(input, input.3);
                    DVec3::new(x, y, -1.0).normalize().into()
                },
            ),
            Mistake::new(
                "the lens point is added; the direction from it to the point in focus is the difference",
                |&(screen, tangent, [x, y], focus)| lens_ray(screen, tangent, [-x, -y], focus),
            ),
            Mistake::new("the lens point is multiplied by the tangent; it already is in camera space", |input| {
                let &(screen, tangent, [x, y], focus) = input;
                lens_ray(screen, tangent, [x * tangent, y * tangent], focus)
            }),
            Mistake::new(
                "the lens point is divided by the focus distance, and P is not; both are, or neither",
                |input| {
                    let &(screen, tangent, [x, y], focus) = input;
                    lens_ray(screen, tangent, [x / focus, y / focus], focus)
                },
            ),
            Mistake::new("the tangent is left out", |&(screen, _, lens, focus)| lens_ray(screen, 1.0, lens, focus)),
            Mistake::new(
                "the screen point is divided by the tangent; its place on the image plane is the product of the two",
                |input| {
                    let &(screen, tangent, lens, focus) = input;
                    lens_ray(screen, 1.0 / tangent, lens, focus)
                },
            ),
            Mistake::new("tan_half_vertical is taken for an angle; it is the tangent already", |input| {
                let &(screen, tangent, lens, focus) = input;
                lens_ray(screen, libm::tan(tangent), lens, focus)
            }),
            Mistake::new("tan_half_vertical is halved; it belongs to half the angle already", |input| {
                let &(screen, tangent, lens, focus) = input;
                lens_ray(screen, tangent / 2.0, lens, focus)
            }),
            Mistake::new(
                "tan_half_vertical is doubled; screen points go from −1 to 1, so they take it once",
                |input| {
                    let &(screen, tangent, lens, focus) = input;
                    lens_ray(screen, tangent * 2.0, lens, focus)
                },
            ),
            Mistake::new("the direction is not of length 1", |input| not_normalised(input, input.3)),
            Mistake::new("the direction is not of length 1", |input| {
                not_normalised(input, input.3).map(|part| part / input.3)
            }),
            Mistake::new("the direction is not of length 1", |input| {
                let &([x, y], tangent, ..) = input;
                let longer = DVec3::new(x * tangent, y * tangent, 1.0).length();
                not_normalised(input, input.3 / longer)
            }),
            Mistake::new("the direction is not of length 1", |input| {
                not_normalised(input, input.3)
                    .map(|part| part / DVec3::from(not_normalised(input, input.3)).length_squared())
            }),
            Mistake::new("the direction goes from the focus to the lens: it is P − L, not L − P", |input| {
                let &(screen, tangent, lens, focus) = input;
                lens_ray(screen, tangent, lens, focus).map(|part| -part)
            }),
            Mistake::new("y is turned round; screen points have y upwards, as camera space has", |input| {
                let &([x, y], tangent, lens, focus) = input;
                lens_ray([x, -y], tangent, lens, focus)
            }),
            Mistake::new("the plane in focus stands at z = +f; the camera looks down −z", |input| {
                let &(screen, tangent, lens, focus) = input;
                let [x, y, z] = lens_ray(screen, tangent, lens, focus);
                [x, y, -z]
            }),
        ],
        hints: &[
            "find the point in focus first: the pinhole's ray is at (x, y, −1) times the focus distance there",
            "the direction is that point less the lens point, which lies at z = 0",
            "with P = (screen · tan · f, −f) and L = (lens, 0): divide P − L by its length",
        ],
    }
}

fn lens_ray(screen: [f64; 2], tangent: f64, lens: [f64; 2], focus: f64) -> [f64; 3] {
    camera_ray_lens(screen.into(), tangent, lens.into(), focus).into()
}

/// From the lens point to what is that deep on the pinhole's ray.
fn not_normalised(&(screen, tangent, lens, _): &Input, depth: f64) -> [f64; 3] {
    let part = |axis: usize| screen[axis] * tangent * depth - lens[axis];
    [part(0), part(1), -depth]
}

fn asked() -> Vec<Probe<Input>> {
    let at = |seed, radius: f64, focus: [f64; 2]| {
        (0..30).map(move |index| {
            let mut draws = Draws::new(seed, index);
            let screen = [draws.between(-1.78, 1.78), draws.between(-1.0, 1.0)];
            let lens = [draws.between(-radius, radius), draws.between(-radius, radius)];
            (screen, draws.between(0.1, 1.5), lens, draws.between(focus[0], focus[1]))
        })
    };
    let mut asked: Vec<_> = probes("the middle of image and lens", [([0.0, 0.0], 0.5, [0.0, 0.0], 3.0)]).collect();
    asked.extend(probes("the middle of the image, the edge of the lens", [([0.0, 0.0], 0.5, [0.25, 0.0], 4.0)]));
    asked.extend(probes("a focus at 1", at(2301, 0.2, [1.0, 1.0])));
    asked.extend(probes("an ordinary lens", at(2302, 0.2, [2.0, 20.0])));
    asked.extend(probes("the middle of the lens", at(2303, 0.0, [2.0, 20.0])));
    asked.extend(probes("a lens wider than its focus is far", at(2304, 50.0, [0.5, 2.0])));
    asked
}
