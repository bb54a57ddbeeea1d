//! Chapter 18: the variance of a pixel from run to run, and the square of its bias.

use pinhole_lab::exercise::apart::option;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;

/// Runs, truth.
type Input = (Vec<f64>, f64);
type Answer = Option<[f64; 2]>;

/// Why `render 18 --mine` makes no picture.
const NOT_SEEN: &str = "variance_and_bias_squared stands in no stage: it compares many renders, and a picture is one; \
                        `report 18` shows both";

/// What the reader writes.
pub type Yours = fn(&[f64], f64) -> Answer;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::variance_and_bias_squared)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::unseen("variance_and_bias_squared", question, move |(runs, truth)| yours(runs, *truth), NOT_SEEN)
}

fn question() -> Question<Input, Answer> {
    Question {
        pinhole_has: ("src/lab/report/ensemble.rs", "fn bias_squared"),
        probes: asked(),
        tell: |(runs, truth)| format!("runs {}, truth {truth:?}", told(runs)),
        right: |input| answer(input, variance, pairs),
        apart: |yours, right| option(yours, right, apart),
        allowed: 1e-9,
        measured: "of the two numbers together",
        mistakes: vec![
            Mistake::new("one run tells no variance, and none tells nothing: the answer there is None", |input| {
                answer(input, variance, pairs).or_else(|| Some([0.0, square(&off(input))]))
            }),
            Mistake::new(
                "the variance is divided by the number of runs; their mean lies amid them, so it comes out too small, and one \
                 less is right",
                |input| {
                    answer(input, |input| variance(input) * (input.0.len() - 1) as f64 / input.0.len() as f64, pairs)
                },
            ),
            Mistake::new(
                "the variance is taken about the truth; it is the scatter about the runs' own mean",
                |input| answer(input, about_truth, pairs),
            ),
            Mistake::new(
                "bias² is the square of the mean's distance from the truth, or pairs a run with itself: a part of the \
                 variance is left in it",
                |input| answer(input, variance, |input| square(&off(input))),
            ),
            Mistake::new("a bias² below 0 is cut off; then its mean over many pixels is too large", |input| {
                answer(input, variance, |input| pairs(input).max(0.0))
            }),
            Mistake::new(
                "the variance is the mean of squares less the square of the mean: where the noise is small against the value, \
                 nothing is left but rounding",
                |input| answer(input, by_squares, pairs),
            ),
            Mistake::new("the two numbers are swapped", |input| {
                answer(input, variance, pairs).map(|[variance, bias]| [bias, variance])
            }),
        ],
        hints: &[
            "take the truth from every run first; then both numbers are made of these distances",
            "variance: Σ (d − their mean)² / (n − 1); bias²: the mean of dᵢ · dⱼ over i ≠ j",
            "the sum over i ≠ j of dᵢ · dⱼ is (Σ d)² − Σ d², and there are n (n − 1) such pairs; below two runs None",
        ],
    }
}

fn told(runs: &[f64]) -> String {
    format!("[{}]", runs.iter().map(Shown::shown).collect::<Vec<_>>().join(", "))
}

fn apart(yours: &[f64; 2], right: &[f64; 2]) -> f64 {
    let together = right[0].abs() + right[1].abs();
    let off = (yours[0] - right[0]).abs().max((yours[1] - right[1]).abs());
    match (yours.iter().any(|part| part.is_nan()), together > 0.0) {
        (true, _) => f64::INFINITY,
        (_, true) => off / together,
        _ => off,
    }
}

fn asked() -> Vec<Probe<Input>> {
    let scattered = |seed, size: f64, bias: f64| {
        (0..20).map(move |at| {
            let mut draws = Draws::new(seed, at);
            let truth = size * draws.between(0.5, 2.0);
            let runs = (0..2 + at % 15).map(|_| truth + bias + draws.between(-1.0, 1.0)).collect();
            (runs, truth)
        })
    };
    let mut asked: Vec<_> = probes("a few runs", [(vec![1.0, 2.0, 4.0], 2.0), (vec![0.5, 0.7], 0.4)]).collect();
    asked.extend(probes("runs about the truth", scattered(1801, 1.0, 0.0)));
    asked.extend(probes("runs with a bias", scattered(1802, 1.0, 3.0)));
    asked.extend(probes("runs whose errors cancel", [(vec![1.0, 3.0], 2.0), (vec![-1.0, 1.0, -1.0, 1.0], 0.0)]));
    asked.extend(probes("runs that agree", [(vec![0.25; 5], 0.25), (vec![0.5; 4], 0.25)]));
    asked.extend(probes("a single run", [(vec![0.5], 0.25)]));
    asked.extend(probes("no run at all", [(vec![], 0.25)]));
    asked.extend(probes("a value of about 1e9 with noise of about 1", scattered(1803, 1e9, 0.0)));
    asked
}

fn answer(input: &Input, variance: impl Fn(&Input) -> f64, bias: impl Fn(&Input) -> f64) -> Answer {
    (input.0.len() > 1).then(|| [variance(input), bias(input)])
}

fn off((runs, truth): &Input) -> Vec<f64> {
    runs.iter().map(|run| run - truth).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

fn square(values: &[f64]) -> f64 {
    mean(values) * mean(values)
}

fn variance(input: &Input) -> f64 {
    let off = off(input);
    let mean = mean(&off);
    off.iter().map(|off| (off - mean) * (off - mean)).sum::<f64>() / (off.len() - 1) as f64
}

/// Pair by pair, as the words have it.
fn pairs(input: &Input) -> f64 {
    let off = off(input);
    let mut sum = 0.0;
    for one in 0..off.len() {
        sum += (0..off.len()).filter(|&other| other != one).map(|other| off[one] * off[other]).sum::<f64>();
    }
    sum / (off.len() * (off.len() - 1)) as f64
}

fn about_truth(input: &Input) -> f64 {
    off(input).iter().map(|off| off * off).sum::<f64>() / (input.0.len() - 1) as f64
}

fn by_squares((runs, _): &Input) -> f64 {
    let n = runs.len() as f64;
    let squares: f64 = runs.iter().map(|run| run * run).sum();
    (squares / n - square(runs)) * n / (n - 1.0)
}
