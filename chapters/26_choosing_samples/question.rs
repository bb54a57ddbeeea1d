//! Chapter 26: the power heuristic, for pdfs of any size.

use super::mine::mine;
use pinhole::follow::power_heuristic;
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;

pub(super) type Input = (f64, f64);

/// What the reader writes.
pub type Yours = fn(f64, f64) -> f64;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::power_heuristic)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("power_heuristic", question, move |&(own, other)| yours(own, other), mine)
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/follow/emission.rs", "power_heuristic"),
        probes: asked(),
        tell: |(own, other)| format!("own {}, other {}", own.shown(), other.shown()),
        right: |&(own, other)| power_heuristic(own, other),
        apart: |yours, right| absolute(&[*yours], &[*right]),
        allowed: 1e-12,
        measured: "of 1",
        mistakes: vec![
            Mistake::new("that is the balance heuristic; both pdfs are squared here", |&(own, other)| {
                if own == 0.0 { 0.0 } else { own / (own + other) }
            }),
            Mistake::new("the two are swapped: the larger pdf has more weight", |&(own, other)| {
                power_heuristic(other, own)
            }),
            Mistake::new(
                "squares overflow to infinity or vanish to 0, and their quotient is NaN or wrong; square only \
                 the ratio of the two",
                |&(own, other)| if own == 0.0 { 0.0 } else { own * own / (own * own + other * other) },
            ),
            Mistake::new(
                "squares overflow to infinity or vanish to 0, and their quotient is NaN or wrong; square only \
                 the ratio of the two, and return 0 where own is 0",
                |&(own, other)| own * own / (own * own + other * other),
            ),
            Mistake::new(
                "0 is divided by 0 where neither technique samples the path; there the weight is 0",
                |&(own, other)| {
                    let ratio = other / own;
                    1.0 / (1.0 + ratio * ratio)
                },
            ),
            Mistake::new("each counts half; the larger pdf has more weight", |_| 0.5),
        ],
        hints: &[
            "with two pdfs alike the answer is 1/2, and with one three times the other 9/10",
            "divide numerator and denominator by own²: only the ratio of the two pdfs is left",
            "1 / (1 + (other / own)²), and 0 where own is 0; a ratio that is infinite gives 0 by itself",
        ],
    }
}

fn asked() -> Vec<Probe<Input>> {
    let mut asked: Vec<_> = probes("pdfs alike", [(3.0, 3.0), (3.0, 1.0), (1.0, 3.0)]).collect();
    let of = |seed, count: u64, least: f64, most: f64| {
        (0..count).map(move |at| {
            let mut draws = Draws::new(seed, at);
            let own = draws.power_of_ten(least, most);
            (own, own * draws.power_of_ten(-1.5, 1.5))
        })
    };
    asked.extend(probes("ordinary pdfs", of(2601, 40, -3.0, 3.0)));
    asked.extend(probes("one that cannot sample the path", [(0.0, 2.0), (2.0, 0.0)]));
    asked.extend(probes("pdfs too large to be squared", of(2602, 30, 160.0, 290.0)));
    asked.extend(probes("pdfs too small to be squared", of(2603, 30, -290.0, -170.0)));
    asked.extend(probes("one of each", [(1e200, 1e-200), (1e-200, 1e200)]));
    asked.extend(probes("neither samples the path", [(0.0, 0.0)]));
    asked
}
