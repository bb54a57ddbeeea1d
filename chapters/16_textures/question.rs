//! Chapter 16: the mean of stripes over what a pixel covers.

use super::mine::mine;
use pinhole::shade::{wave, wave_mean};
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;

/// The middle of a range, its width.
pub(super) type Input = (f64, f64);

/// What the reader writes.
pub type Yours = fn(f64, f64) -> f64;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::mean_of_stripes)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("mean_of_stripes", question, move |&(x, width)| yours(x, width), mine)
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/shade/checker.rs", "wave_mean"),
        probes: asked(),
        tell: |(x, width)| format!("x {}, width {}", x.shown(), width.shown()),
        right: |&(x, width)| wave_mean(x, width),
        apart: |yours, right| absolute(&[*yours], &[*right]),
        allowed: 1e-9,
        measured: "of 1",
        mistakes: vec![
            Mistake::new(
                "this is the stripe at x itself; asked for is the mean of all that the range covers",
                |&(x, _)| wave(x),
            ),
            Mistake::new(
                "the range reaches from x to x + width; half of it lies on either side of x",
                |&(x, width)| wave_mean(x + 0.5 * width, width),
            ),
            Mistake::new(
                "the range reaches width to either side of x, which is twice as wide as width",
                |&(x, width)| wave_mean(x, 2.0 * width),
            ),
            Mistake::new("below 0 the stripes are mirrored; stripe −1, from −1 to 0, is odd", |&(x, width)| {
                if x < 0.0 { -wave_mean(x, width) } else { wave_mean(x, width) }
            }),
            Mistake::new("a range without width has no mean by division: it is its one point", |&(x, width)| {
                if width == 0.0 { f64::NAN } else { wave_mean(x, width) }
            }),
            Mistake::new("this is the area; divided by the width it is the mean", |&(x, width)| {
                wave_mean(x, width) * width
            }),
            Mistake::new("odd stripes count as 1 and even ones as −1; it is the reverse", |&(x, width)| {
                -wave_mean(x, width)
            }),
        ],
        hints: &[
            "draw the stripes as a curve that is 1 over [0, 1), −1 over [1, 2), and so on; a mean is an area over a width",
            "the area from 0 to x rises from 0 to 1 over an even stripe and falls back to 0 over the odd one after it: \
             a zigzag of period 2",
            "with m = x.rem_euclid(2.0), the zigzag is 1 − |m − 1|; call it area(x)",
            "so (area(x + width / 2) − area(x − width / 2)) / width; where width is 0, 1 or −1 as x.floor() is even or odd",
        ],
    }
}

fn asked() -> Vec<Probe<Input>> {
    let anywhere = |seed, most: f64| {
        (0..40).map(move |at| {
            let mut draws = Draws::new(seed, at);
            (draws.between(-most, most), draws.between(0.01, 8.0))
        })
    };
    let mut asked: Vec<_> = probes("inside a stripe", [(0.5, 0.5), (1.5, 0.25), (2.25, 0.125)]).collect();
    asked.extend(probes("half of one stripe and half of the next", [(1.0, 1.0), (2.0, 0.5)]));
    asked.extend(probes("more of one stripe than of the next", [(1.25, 1.0), (1.75, 1.0), (0.875, 0.5)]));
    asked.extend(probes("several stripes", [(1.5, 3.0), (0.5, 3.0), (2.25, 2.5)]));
    asked.extend(probes("stripes below 0", [(-0.5, 0.5), (-1.25, 1.0), (-2.5, 0.25)]));
    asked.extend(probes("a range without width", [(0.25, 0.0), (1.5, 0.0), (-0.5, 0.0), (3.0, 0.0)]));
    asked.extend(probes("anywhere from −20 to 20", anywhere(1601, 20.0)));
    asked.extend(probes("a thousand stripes", [(0.5, 1001.0), (3.75, 999.5)]));
    asked.extend(probes("far from 0", anywhere(1602, 1e4)));
    asked
}
