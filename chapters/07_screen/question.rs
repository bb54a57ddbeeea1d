//! Chapter 07: from the screen back to NDC, compared with exact arithmetic.

use super::mine::mine;
use pinhole::rays::screen_from_ndc;
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::exact::Dyadic;
use pinhole_lab::measure::ray_aim::Draws;

pub(super) type Input = ([f64; 2], u32, u32);

/// What the reader writes.
pub type Yours = fn([f64; 2], u32, u32) -> [f64; 2];

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("ndc_from_screen", question, move |&(screen, width, height)| yours(screen, width, height), mine)
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
        mistakes: vec![
            Mistake::new("the aspect is left out: x runs from −aspect to aspect", |i| {
                answer(i, |x, _| (x + 1.0) / 2.0, down)
            }),
            Mistake::new("x is multiplied by the aspect; to undo that, divide", |i| {
                answer(i, |x, a| (x * a + 1.0) / 2.0, down)
            }),
            Mistake::new("the aspect is taken off y; only x is as much longer as the image is wider", |i| {
                answer(i, |x, _| (x + 1.0) / 2.0, |y, a| (1.0 - y / a) / 2.0)
            }),
            Mistake::new("the aspect is put into y; only x is as much longer as the image is wider", |i| {
                answer(i, |x, _| (x + 1.0) / 2.0, |y, a| (1.0 - y * a) / 2.0)
            }),
            Mistake::new(BOTH, |i| answer(i, across, |y, a| (1.0 - y / a) / 2.0)),
            Mistake::new(BOTH, |i| answer(i, across, |y, a| (1.0 - y * a) / 2.0)),
            Mistake::new(
                "the shorter side is taken to run from −1 to 1; it is the height, also of an image that is higher \
                 than wide",
                |i| answer(i, |x, a| (x / a.max(1.0) + 1.0) / 2.0, |y, a| (1.0 - y * a.min(1.0)) / 2.0),
            ),
            Mistake::new(
                "the longer side is taken to run from −1 to 1; it is the height, also of an image that is wider than \
                 high",
                |i| answer(i, |x, a| (x / a.min(1.0) + 1.0) / 2.0, |y, a| (1.0 - y * a.max(1.0)) / 2.0),
            ),
            Mistake::new("the aspect divides whole numbers, 480 / 270 = 1: make them f64 first", |&([x, y], w, h)| {
                [(x / f64::from(w / h) + 1.0) / 2.0, (1.0 - y) / 2.0]
            }),
            Mistake::new("y is not turned over: on the screen it points up, in NDC down", |i| {
                answer(i, across, |y, _| (y + 1.0) / 2.0)
            }),
            Mistake::new(SIGN, |i| answer(i, across, |y, _| -(y + 1.0) / 2.0)),
            Mistake::new(SIGN, |i| answer(i, across, |y, _| (y - 1.0) / 2.0)),
            Mistake::new("x is turned over; it points right in both", |i| answer(i, |x, a| 1.0 - across(x, a), down)),
            Mistake::new("1 is taken off x, but −aspect on the screen is 0 in NDC: it is to be added", |i| {
                answer(i, |x, a| (x / a - 1.0) / 2.0, down)
            }),
            Mistake::new("the point is still from −1 to 1; NDC runs from 0 to 1", |i| {
                answer(i, |x, a| x / a, |y, _| -y)
            }),
            Mistake::new("the point is still from −1 to 1; NDC runs from 0 to 1", |i| {
                answer(i, |x, a| x / a, |y, _| y)
            }),
            Mistake::new("the point runs from 0 to 2; the division by 2 is missing", |i| {
                answer(i, |x, a| x / a + 1.0, |y, _| 1.0 - y)
            }),
            Mistake::new("the point runs from −1/2 to 1/2; a half is to be added", |i| {
                answer(i, |x, a| x / a / 2.0, |y, _| -y / 2.0)
            }),
            Mistake::new("only y is halved; x has the division by 2, too", |i| answer(i, |x, a| x / a + 1.0, down)),
            Mistake::new("only x is halved; y has the division by 2, too", |i| answer(i, across, |y, _| 1.0 - y)),
            Mistake::new(BRACKETS, |i| answer(i, |x, a| x / a + 0.5, |y, _| 1.0 - y / 2.0)),
            Mistake::new(BRACKETS, |i| answer(i, across, |y, _| 1.0 - y / 2.0)),
            Mistake::new(BRACKETS, |i| answer(i, |x, a| x / a + 0.5, down)),
            Mistake::new(BRACKETS, |i| answer(i, |x, a| x / a / 2.0 + 1.0, |y, _| 1.0 - y / 2.0)),
            Mistake::new("1 is added before the aspect is taken off; undo the last step first", |i| {
                answer(i, |x, a| (x + 1.0) / 2.0 / a, down)
            }),
            Mistake::new("1 is added where the aspect belongs: (x + aspect) / 2 is still to be divided by it", |i| {
                answer(i, |x, a| (x + a) / 2.0, down)
            }),
            Mistake::new("1 is added where the aspect belongs: (x + aspect) / 2 is still to be divided by it", |i| {
                answer(i, |x, a| x + a, down)
            }),
            Mistake::new("this is screen_from_ndc itself, not what undoes it", |i| {
                answer(i, |x, a| (2.0 * x - 1.0) * a, |y, _| 1.0 - 2.0 * y)
            }),
            Mistake::new("this is the raster point; NDC runs from 0 to 1", |i| {
                let [x, y] = answer(i, across, down);
                [x * f64::from(i.1), y * f64::from(i.2)]
            }),
            Mistake::new("x and y are swapped", |i| {
                let [x, y] = answer(i, across, down);
                [y, x]
            }),
            Mistake::new(CLAMPED, |i| {
                answer(i, |x, a| across(x, a).clamp(0.0, 1.0), |y, a| down(y, a).clamp(0.0, 1.0))
            }),
            Mistake::new(CLAMPED, |i| answer(i, |x, a| across(x.clamp(-a, a), a), |y, a| down(y.clamp(-1.0, 1.0), a))),
            Mistake::new("x is multiplied by the aspect; to undo that, divide", |i| {
                answer(i, |x, a| (x + 1.0) / 2.0 * a, down)
            }),
            Mistake::new("x is still from −1 to 1; NDC runs from 0 to 1", |i| answer(i, |x, a| x / a, down)),
            Mistake::new("x runs from −1/2 to 1/2; a half is to be added", |i| answer(i, |x, a| x / a / 2.0, down)),
            Mistake::new("y is still from −1 to 1; NDC runs from 0 to 1", |i| answer(i, across, |y, _| -y)),
            Mistake::new("y is still from −1 to 1; NDC runs from 0 to 1", |i| answer(i, across, |y, _| y)),
            Mistake::new("y runs from −1/2 to 1/2; a half is to be added", |i| answer(i, across, |y, _| -y / 2.0)),
            Mistake::new("y is turned over, but runs from −1 to 0 or from 1 to 2; NDC runs from 0 to 1", |i| {
                answer(i, across, |y, _| 1.0 + down(y, 0.0))
            }),
            Mistake::new("f32 is computed in, which has seven digits", |&([x, y], w, h)| {
                let aspect = f64::from(w as f32 / h as f32);
                [across(x, aspect), down(y, aspect)]
            }),
            Mistake::new("f32 is computed in, which has seven digits", |&([x, y], w, h)| {
                let aspect = w as f32 / h as f32;
                [(x as f32 / aspect + 1.0) / 2.0, (1.0 - y as f32) / 2.0].map(f64::from)
            }),
            Mistake::new("the steps are undone in the order in which they were made; undo the last step first", |i| {
                answer(i, |x, a| (x + 1.0) / 2.0 / a, |y, _| -(y + 1.0) / 2.0)
            }),
        ],
        hints: &[
            "write down x and y of the screen as the page has them, and solve each for NDC",
            "the aspect, width / height as f64, was the last thing done to x, so it is the first to be undone",
            "x = (screen x / aspect + 1) / 2 and y = (1 − screen y) / 2",
        ],
    }
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
    (screen_from_ndc(ndc.into(), aspect(width, height)).into(), width, height)
}

/// (x · height / width + 1) / 2 and (1 − y) / 2, each rounded once.
fn undone([x, y]: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let one = Dyadic::of(1);
    let across = (&Dyadic::of(x) * &Dyadic::of(height)).divided_by(&Dyadic::of(width));
    [(&across + &one).scaled(-1).to_f64(), (&one - &Dyadic::of(y)).scaled(-1).to_f64()]
}

fn aspect(width: u32, height: u32) -> f64 {
    f64::from(width) / f64::from(height)
}

const BOTH: &str = "the aspect is taken off y, too; on the screen y runs from −1 to 1 in every image";
const SIGN: &str = "y has the wrong sign: it is (1 − y) / 2, which is 0 at the upper edge";
const BRACKETS: &str = "the brackets are missing: the sum is halved, not one of its terms";
const CLAMPED: &str = "a point outside is put onto the image's edge; it has its NDC too, below 0 or above 1";

/// What two functions of a part and the aspect make of it.
fn answer(&([x, y], width, height): &Input, of_x: fn(f64, f64) -> f64, of_y: fn(f64, f64) -> f64) -> [f64; 2] {
    [of_x(x, aspect(width, height)), of_y(y, aspect(width, height))]
}

fn across(x: f64, aspect: f64) -> f64 {
    (x / aspect + 1.0) / 2.0
}

fn down(y: f64, _: f64) -> f64 {
    (1.0 - y) / 2.0
}
