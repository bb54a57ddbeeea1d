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

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::ndc_from_screen)
}

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
            Mistake::new("the aspect is left out: x runs from −aspect to aspect", |&([x, y], _, _)| {
                [(x + 1.0) / 2.0, (1.0 - y) / 2.0]
            }),
            Mistake::new("x is multiplied by the aspect; to undo that, divide", |&([x, y], w, h)| {
                [(x * aspect(w, h) + 1.0) / 2.0, (1.0 - y) / 2.0]
            }),
            Mistake::new(
                "the aspect is taken off y; only x is as much longer as the image is wider",
                |&([x, y], w, h)| [(x + 1.0) / 2.0, (1.0 - y / aspect(w, h)) / 2.0],
            ),
            Mistake::new("the aspect divides whole numbers, 480 / 270 = 1: make them f64 first", |&([x, y], w, h)| {
                [(x / f64::from(w / h) + 1.0) / 2.0, (1.0 - y) / 2.0]
            }),
            Mistake::new("y is not turned over: on the screen it points up, in NDC down", |&(screen, w, h)| {
                let [x, y] = undone(screen, w, h);
                [x, 1.0 - y]
            }),
            Mistake::new("the point is still from −1 to 1; NDC runs from 0 to 1", |&([x, y], w, h)| {
                [x / aspect(w, h), -y]
            }),
            Mistake::new("1 is added before the aspect is taken off; undo the last step first", |&([x, y], w, h)| {
                [(x + 1.0) / 2.0 / aspect(w, h), (1.0 - y) / 2.0]
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
