//! Chapter 07: from the screen back to NDC, compared with exact arithmetic.

use bevy_ecs::prelude::*;
use pinhole::extract::ImageFrame;
use pinhole::plan::{Column, Shared, VectorRows, VectorRowsMut};
use pinhole::rays;
use pinhole::rays::{ScreenPoints, screen_from_ndc};
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Probe, Question, RowPlaces, Setting, Shown, StandIn, probes,
};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::exact::Dyadic;

type Input = ([f64; 2], u32, u32);

/// What the reader writes.
pub type Yours = fn([f64; 2], u32, u32) -> [f64; 2];

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("ndc_from_screen", question, move |&(screen, width, height)| yours(screen, width, height), mine)
        .and_in("90 x 160, and beyond it", |_| ())
}

fn question() -> Question<Input, [f64; 2]> {
    Question {
        pinhole_has: ("src/pinhole/rays/screen.rs", "screen_from_ndc"),
        probes: asked(),
        tell: |(screen, width, height)| format!("screen {}, width {width}, height {height}", screen.shown()),
        right: |&(screen, width, height)| undone(screen, width, height),
        apart: |yours, right| absolute(yours, right),
        allowed: 1e-15,
        measured: "of the image's width or height",
        mistakes: mistakes(),
        hints: &[
            "write down x and y of the screen as the page has them, and solve each for NDC",
            "the aspect, width / height as f64, was the last thing done to x, so it is the first to be undone",
            "after the aspect, x has two steps to undo, and y has the same two; in one of them y changes its sign",
        ],
    }
}

fn mistakes() -> Mistakes<Input, [f64; 2]> {
    let x = Part::<Input, f64>::new(|i| (along(i) + 1.0) / 2.0)
        .say("the aspect is left out: x runs from −aspect to aspect")
        .when(|i| (i.0[0] + 1.0) / 2.0)
        .say("x is multiplied by the aspect; to undo that, divide")
        .when(|i| (i.0[0] * aspect(i) + 1.0) / 2.0)
        .when(|i| (i.0[0] + 1.0) / 2.0 * aspect(i))
        .say("the aspect divides whole numbers, 480 / 270 = 1: make them f64 first")
        .when(|&([x, _], w, h)| (x / f64::from(w / h) + 1.0) / 2.0)
        .when(|&([x, _], w, h)| (x / f64::from((w / h).max(1)) + 1.0) / 2.0)
        .say("x is turned over; it points right in both")
        .when(|i| 1.0 - (along(i) + 1.0) / 2.0)
        .say("1 is taken off x, but −aspect on the screen is 0 in NDC: it is to be added")
        .when(|i| (along(i) - 1.0) / 2.0)
        .say("1 is added before the aspect is taken off; undo the last step first")
        .when(|i| (i.0[0] + 1.0) / 2.0 / aspect(i))
        .say("1 is added where the aspect belongs: (x + aspect) / 2 is still to be divided by it")
        .when(|i| (i.0[0] + aspect(i)) / 2.0)
        .when(|i| i.0[0] + aspect(i))
        .say(STILL)
        .when(along)
        .say(TWICE)
        .when(|i| along(i) + 1.0)
        .say(HALF)
        .when(|i| along(i) / 2.0)
        .say(BRACKETS)
        .when(|i| along(i) + 0.5)
        .when(|i| along(i) / 2.0 + 1.0)
        .say(CLAMPED)
        .when(|i| ((along(i) + 1.0) / 2.0).clamp(0.0, 1.0))
        .when(|i| (i.0[0].clamp(-aspect(i), aspect(i)) / aspect(i) + 1.0) / 2.0);
    let y = Part::<Input, f64>::new(|i| (1.0 - i.0[1]) / 2.0)
        .say("the aspect is taken off y, too; on the screen y runs from −1 to 1 in every image")
        .when(|i| (1.0 - i.0[1] / aspect(i)) / 2.0)
        .when(|i| (1.0 - i.0[1] * aspect(i)) / 2.0)
        .say("y is not turned over: on the screen it points up, in NDC down")
        .when(|i| (i.0[1] + 1.0) / 2.0)
        .say("y has the wrong sign: it is (1 − y) / 2, which is 0 at the upper edge")
        .when(|i| -(i.0[1] + 1.0) / 2.0)
        .when(|i| (i.0[1] - 1.0) / 2.0)
        .say("y is turned over, but runs from −1 to 0 or from 1 to 2; NDC runs from 0 to 1")
        .when(|i| 1.0 + (1.0 - i.0[1]) / 2.0)
        .say(STILL)
        .when(|i| -i.0[1])
        .when(|i| i.0[1])
        .say(TWICE)
        .when(|i| 1.0 - i.0[1])
        .say(HALF)
        .when(|i| -i.0[1] / 2.0)
        .say(BRACKETS)
        .when(|i| 1.0 - i.0[1] / 2.0)
        .when(|i| 0.5 - i.0[1])
        .say(CLAMPED)
        .when(|i| ((1.0 - i.0[1]) / 2.0).clamp(0.0, 1.0));
    let whole = Part::<[f64; 2], [f64; 2]>::new(|&ndc| ndc).say("x and y are swapped").when(|&[x, y]| [y, x]);
    Mistakes::<Input, [f64; 2]>::new()
        .say("the aspect is taken of width − 1 and height − 1; it is of all the pixels")
        .when(|&([x, y], w, h)| [(x / aspect(&([x, y], w.max(2) - 1, h.max(2) - 1)) + 1.0) / 2.0, (1.0 - y) / 2.0])
        .say("the aspect is taken off y; only x is as much longer as the image is wider")
        .when(|i| [(i.0[0] + 1.0) / 2.0, (1.0 - i.0[1] / aspect(i)) / 2.0])
        .say("the aspect is put into y; only x is as much longer as the image is wider")
        .when(|i| [(i.0[0] + 1.0) / 2.0, (1.0 - i.0[1] * aspect(i)) / 2.0])
        .say(
            "the shorter side is taken to run from −1 to 1; it is the height, also of an image that is higher \
                 than wide",
        )
        .when(|i| [(i.0[0] / aspect(i).max(1.0) + 1.0) / 2.0, (1.0 - i.0[1] * aspect(i).min(1.0)) / 2.0])
        .say(
            "the longer side is taken to run from −1 to 1; it is the height, also of an image that is wider \
                 than high",
        )
        .when(|i| [(i.0[0] / aspect(i).min(1.0) + 1.0) / 2.0, (1.0 - i.0[1] * aspect(i).max(1.0)) / 2.0])
        .say("this is screen_from_ndc itself, not what undoes it")
        .when(|i| [(2.0 * i.0[0] - 1.0) * aspect(i), 1.0 - 2.0 * i.0[1]])
        .say("this is the raster point; NDC runs from 0 to 1")
        .when(|i| [(along(i) + 1.0) / 2.0 * f64::from(i.1), (1.0 - i.0[1]) / 2.0 * f64::from(i.2)])
        .say("f32 is computed in, which has seven digits")
        .when(|&([x, y], w, h)| [(x / f64::from(w as f32 / h as f32) + 1.0) / 2.0, (1.0 - y) / 2.0])
        .when(|&([x, y], w, h)| {
            let aspect = w as f32 / h as f32;
            [(x as f32 / aspect + 1.0) / 2.0, (1.0 - y as f32) / 2.0].map(f64::from)
        })
        .say("the steps are undone in the order in which they were made; undo the last step first")
        .when(|i| [(i.0[0] + 1.0) / 2.0 / aspect(i), -(i.0[1] + 1.0) / 2.0])
        .of_parts([x, y], whole)
}

fn asked() -> Vec<Probe<Input>> {
    let corners = |width: u32, height: u32| {
        [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.5, 0.5], [0.25, 0.75]].map(|ndc| on(ndc, width, height))
    };
    let anywhere = |seed, width, height| {
        (0..20).map(move |at| {
            let mut draws = Draws::new(seed, at);
            on([draws.unit(), draws.unit()], width, height)
        })
    };
    let mut asked: Vec<_> = probes("a square image", corners(100, 100)).collect();
    asked.extend(probes("corners and centre of 200 × 100", corners(200, 100)));
    asked.extend(probes("corners and centre of 100 × 200", corners(100, 200)));
    asked.extend(probes("anywhere in 480 × 270", anywhere(701, 480, 270)));
    asked.extend(probes("anywhere in 270 × 480", anywhere(702, 270, 480)));
    asked.extend(probes("an image of one pixel", corners(1, 1)));
    asked.extend(probes("an image one pixel high", anywhere(703, 65_536, 1)));
    asked.extend(probes("an image one pixel wide", anywhere(704, 1, 65_536)));
    asked.extend(probes("outside the image", [([3.0, 2.0], 300, 200), ([-3.0, -2.0], 200, 300)]));
    asked
}

/// Pinhole's own screen point of an NDC point.
fn on(ndc: [f64; 2], width: u32, height: u32) -> Input {
    (screen_from_ndc(ndc.into(), f64::from(width) / f64::from(height)).into(), width, height)
}

/// (x · height / width + 1) / 2 and (1 − y) / 2, each rounded once.
fn undone([x, y]: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let one = Dyadic::of(1);
    let across = (&Dyadic::of(x) * &Dyadic::of(height)).divided_by(&Dyadic::of(width));
    [(&across + &one).scaled(-1).to_f64(), (&one - &Dyadic::of(y)).scaled(-1).to_f64()]
}

const BRACKETS: &str = "the brackets are missing: the sum is halved, not one of its terms";

const CLAMPED: &str = "a point outside is put onto the image's edge; it has its NDC too, below 0 or above 1";

const STILL: &str = "a part is still from −1 to 1; NDC runs from 0 to 1";

const TWICE: &str = "a part runs from 0 to 2; its division by 2 is missing";

const HALF: &str = "a part runs from −1/2 to 1/2; a half is to be added";

fn aspect(&(_, width, height): &Input) -> f64 {
    f64::from(width) / f64::from(height)
}

/// x over the aspect.
fn along(input: &Input) -> f64 {
    input.0[0] / aspect(input)
}

/// Every screen point taken to NDC by the reader's function, and back by pinhole's: what undoes it leaves it in place.
fn mine(ask: Ask<Input, [f64; 2]>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    let size = setting.resolution();
    StandIn::after(
        rays::screen_stage,
        move |image: Res<Shared<ImageFrame>>, mut tiles: Query<(RowPlaces, &mut ScreenPoints)>| {
            for (place, mut screen) in &mut tiles {
                for row in 0..screen.rows() {
                    let asked = (screen.point.at(row), size.width, size.height);
                    if let Some(ndc) = ask.at(place, row, asked) {
                        screen.point.put(row, screen_from_ndc(ndc.into(), image.aspect()));
                    }
                }
            }
        },
    )
}

/// Screen points of a tall image and beyond it, as the NDC that come out, which are drawn half as large.
fn painted(ask: Ask<Input, [f64; 2]>) -> StandIn {
    StandIn::painted([64, 64], move |[x, y]| {
        let [right, up] = [f64::from(x) / 31.5 - 1.0, 1.0 - f64::from(y) / 31.5];
        let [x, y] = ask.once(([0.9 * right, 1.6 * up], 90, 160)).unwrap_or_default();
        [0.25 + 0.5 * x, 0.25 + 0.5 * y, 0.0]
    })
}
