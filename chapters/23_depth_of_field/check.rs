//! Chapter 23: the direction from a point of the lens through the point in focus.

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::{LensTable, PerspectiveProjection};
use pinhole::plan::{Column, Shared, VectorRows, VectorRowsMut};
use pinhole::rays;
use pinhole::rays::{CameraRays, LensPoints, ScreenPoints, camera_ray_lens};
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Probe, Question, RowPlaces, Setting, Shown, StandIn, probes,
};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::naive::lens::focus_along_the_ray;

type Input = ([f64; 2], f64, [f64; 2], f64);

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
    .and_in("the directions", |_| ())
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
        right: |&(screen, tangent, lens, focus)| camera_ray_lens(screen.into(), tangent, lens.into(), focus).into(),
        apart: |yours, right| relative(yours, right),
        allowed: 1e-12,
        measured: "of a part",
        mistakes: mistakes(),
        hints: &[
            "find the point in focus first: the pinhole's ray is at (x, y, −1) times the focus distance there",
            "the direction is that point less the lens point, which lies at z = 0",
            "write down the three coordinates of both points; the lens has no depth",
        ],
    }
}

fn mistakes() -> Mistakes<Input, [f64; 3]> {
    let x = Part::<Input, f64>::new(|i| i.0[0])
        .say("only y is multiplied by the tangent; x is in half heights, too")
        .when(|i| i.0[0] / i.1);
    let y = Part::<Input, f64>::new(|i| i.0[1])
        .say("only x is multiplied by the tangent; y is, too")
        .when(|i| i.0[1] / i.1)
        .say("y is turned round; screen points have y upwards, as camera space has")
        .when(|i| -i.0[1]);
    let tangent = Part::<Input, f64>::new(|i| i.1)
        .say("the tangent is left out")
        .when(|_| 1.0)
        .say("the screen point is divided by the tangent; its place on the image plane is the product of the two")
        .when(|i| 1.0 / i.1)
        .say("tan_half_vertical is taken for an angle; it is the tangent already")
        .when(|i| libm::tan(i.1))
        .say("tan_half_vertical is halved; it belongs to half the angle already")
        .when(|i| i.1 / 2.0)
        .say("tan_half_vertical is doubled; screen points go from −1 to 1, so they take it once")
        .when(|i| 2.0 * i.1)
        .say(
            "only the depth is multiplied by the focus distance: the point in focus lies on the pinhole's ray, \
                 so x and y are, too",
        )
        .when(|i| i.1 / i.3);
    let [lens_x, lens_y] = [Part::<Input, f64>::new(|i| i.2[0]), Part::new(|i| i.2[1])];
    let lens_x = lens_x
        .say("the x of the lens point is left out")
        .when(|_| 0.0)
        .say(ADDED)
        .when(|i| -i.2[0])
        .say(BY_TANGENT)
        .when(|i| i.2[0] * i.1)
        .say(BY_FOCUS)
        .when(|i| i.2[0] / i.3);
    let lens_y = lens_y
        .say("the y of the lens point is left out")
        .when(|_| 0.0)
        .say(ADDED)
        .when(|i| -i.2[1])
        .say(BY_TANGENT)
        .when(|i| i.2[1] * i.1)
        .say(BY_FOCUS)
        .when(|i| i.2[1] / i.3);
    let focus = Part::<Input, f64>::new(|i| i.3).say("the plane in focus is always at distance 1").when(|_| 1.0);
    let whole = Part::<[f64; 6], [f64; 3]>::new(|of| to_focus(of).normalize().into())
        .say("the direction is not of length 1")
        .when(|of| to_focus(of).into())
        .when(|of| (to_focus(of) / of[5]).into())
        .when(|of| (to_focus(of) / to_focus(of).length_squared()).into())
        .say(
            "only x and y are multiplied by the focus distance: the point in focus lies on the pinhole's ray, \
                 at z = −f",
        )
        .when(|of| DVec3 { z: -1.0, ..to_focus(of) }.normalize().into())
        .say("the direction goes from the focus to the lens: it is P − L, not L − P")
        .when(|of| (-to_focus(of).normalize()).into())
        .say("the lens stands at z = 0, not on the image plane at z = −1")
        .when(|of| DVec3 { z: 1.0 - of[5], ..to_focus(of) }.normalize().into())
        .say("the plane in focus stands at z = +f; the camera looks down −z")
        .when(|of| DVec3 { z: of[5], ..to_focus(of) }.normalize().into());
    Mistakes::<Input, [f64; 3]>::new()
        .say("the focus is taken along the ray: what is sharp is a sphere about the eye, no plane")
        .when(|&(screen, tangent, lens, focus)| focus_along_the_ray(screen.into(), tangent, lens.into(), focus).into())
        .say("the direction is the pinhole's: the lens point is left out")
        .when(|&([x, y], tangent, _, focus)| to_focus(&[x, y, tangent, 0.0, 0.0, focus]).normalize().into())
        .say("the direction is not of length 1")
        .when(|&([x, y], tangent, lens, focus)| {
            let focus = focus / DVec3::new(x * tangent, y * tangent, 1.0).length();
            to_focus(&[x, y, tangent, lens[0], lens[1], focus]).into()
        })
        .of_parts([x, y, tangent, lens_x, lens_y, focus], whole)
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

const ADDED: &str = "the lens point is added; the direction from it to the point in focus is the difference";

const BY_TANGENT: &str = "the lens point is multiplied by the tangent; it already is in camera space";

const BY_FOCUS: &str = "the lens point is divided by the focus distance, and P is not; both are, or neither";

/// From the lens point to the point in focus.
fn to_focus(&[x, y, tangent, lens_x, lens_y, focus]: &[f64; 6]) -> DVec3 {
    DVec3::new(x * tangent * focus - lens_x, y * tangent * focus - lens_y, -focus)
}

/// Directions of rays from points of the lens.
fn mine(ask: Ask<Input, [f64; 3]>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::after(
        rays::lens_stage,
        move |(camera, lens): (Res<Shared<PerspectiveProjection>>, Res<Shared<LensTable>>),
              mut tiles: Query<(RowPlaces, &ScreenPoints, &LensPoints, &mut CameraRays)>| {
            for (place, screen, points, mut rays) in &mut tiles {
                for row in 0..screen.rows() {
                    let (at, point) = (screen.point.at(row), points.point.at(row));
                    let asked = (at, camera.tan_half_vertical, point, lens.focus_distance);
                    if let Some(direction) = ask.at(place, row, asked) {
                        rays.direction.put(row, direction);
                    }
                }
            }
        },
    )
}

/// Directions from a point far out on a wide lens, through a picture that is twice as wide as its distance.
fn painted(ask: Ask<Input, [f64; 3]>) -> StandIn {
    StandIn::painted([64, 32], move |[x, y]| {
        let screen = [(f64::from(x) - 31.5) / 16.0, (15.5 - f64::from(y)) / 16.0];
        let direction = ask.once((screen, 1.0, [0.8, 0.3], 2.0)).unwrap_or_default();
        direction.map(|part| 0.5 + 0.5 * part)
    })
}
