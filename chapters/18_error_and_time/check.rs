//! Chapter 18: the variance of a pixel from run to run, and the square of its bias.

use pinhole_lab::exercise::apart::option;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Probe, Question, Setting, Shown, StandIn, extremes, probes,
};
use pinhole_lab::measure::draws::Draws;

/// Runs, truth.
type Input = (Vec<f64>, f64);

type Answer = Option<[f64; 2]>;

/// What the reader writes.
pub type Yours = fn(&[f64], f64) -> Answer;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("variance_and_bias_squared", question, move |(runs, truth)| yours(runs, *truth), mine)
}

fn question() -> Question<Input, Answer> {
    Question {
        pinhole_has: ("src/lab/report/ensemble.rs", "fn bias_squared"),
        probes: asked(),
        tell: |(runs, truth)| format!("runs {}, truth {truth:?}", told(runs)),
        right,
        apart: |yours, right| option(yours, right, apart),
        allowed: 1e-9,
        measured: "of the two numbers together",
        mistakes: mistakes(),
        hints: &[
            "take the truth from every run first; then both numbers are made of these distances",
            "the variance is taken about the runs' own mean, the bias from the truth; and no run may be paired with \
             itself",
            "a sum over all pairs also holds each run with itself; take these off, and count how many pairs are left",
        ],
    }
}

fn mistakes() -> Mistakes<Input, Answer> {
    let several = Part::<Input, f64>::new(|i| count(i) - 1.0)
        .say("two runs tell nothing; they tell both numbers, if roughly")
        .when(|i| count(i) - 2.0);
    let scatter = Part::<Input, f64>::new(variance)
        .say(
            "the variance is divided by the number of runs; their mean lies amid them, so it comes out too \
                 small, and one less is right",
        )
        .when(|i| variance(i) * (count(i) - 1.0) / count(i))
        .say("the variance is not divided: it is the sum over one less than the number of runs")
        .when(|i| variance(i) * (count(i) - 1.0))
        .say("this is the variance of the mean of all runs; that of one run is asked for")
        .when(|i| variance(i) / count(i))
        .say("this is the standard deviation; the variance is its square")
        .when(|i| variance(i).sqrt())
        .say("the variance is taken about the truth; it is the scatter about the runs' own mean")
        .when(about_truth)
        .when(|i| about_truth(i) * (count(i) - 1.0) / count(i))
        .say("the distances are not squared; without that they cancel or are no variance")
        .when(|i| spread(i, f64::abs))
        .when(|i| spread(i, |off| off))
        .say(
            "the variance is the mean of squares less the square of the mean: where the noise is small against \
                 the value, nothing is left but rounding",
        )
        .when(|i| by_sums(i, |squares, sum, n| (squares / n - sum / n * (sum / n)) * n / (n - 1.0)))
        .when(|i| by_sums(i, |squares, sum, n| (squares - sum * sum / n) / (n - 1.0)))
        .when(|i| by_sums(i, |squares, sum, n| (squares - n * (sum / n) * (sum / n)) / (n - 1.0)))
        .when(|i| by_sums(i, |squares, sum, n| (squares - n * (sum / n * (sum / n))) / (n - 1.0)));
    let bias = Part::<Input, f64>::new(pairs)
        .say(
            "bias² is the square of the mean's distance from the truth, or pairs a run with itself: a part of \
                 the variance is left in it",
        )
        .when(|i| square(&off(i)))
        .when(|i| square(&off(i)) * count(i) / (count(i) - 1.0))
        .say("bias² is the mean of squared distances from the truth; only pairs of two different runs count")
        .when(|i| about_truth(i) * (count(i) - 1.0) / count(i))
        .say(
            "the whole variance is taken off the square of the mean's distance, which is too large by variance \
                 / n only",
        )
        .when(|i| square(&off(i)) - variance(i))
        .when(|i| square(&off(i)) - variance(i) * (count(i) - 1.0) / count(i))
        .say(
            "the square of the mean's distance is lessened by the variance over n − 1 or by one that is too \
                 small; it is too large by variance / n",
        )
        .when(|i| square(&off(i)) - variance(i) / (count(i) - 1.0))
        .when(|i| square(&off(i)) - variance(i) * (count(i) - 1.0) / count(i) / count(i))
        .say("the variance over n is added to the square of the mean's distance; it is in it already: subtract it")
        .when(|i| square(&off(i)) + variance(i) / count(i))
        .say(
            "the pairs are miscounted: n runs make n (n − 1) ordered pairs of two different ones, or half as \
                 many without order",
        )
        .when(|i| pairs(i) / 2.0)
        .when(|i| pairs(i) * 2.0)
        .when(|i| pairs(i) * (count(i) - 1.0) / count(i))
        .when(|i| pairs(i) * (count(i) - 1.0) / count(i) / 2.0)
        .when(|i| pairs(i) * count(i) / (count(i) - 1.0))
        .when(|i| pairs(i) * (count(i) - 1.0))
        .when(|i| pairs(i) * (count(i) - 1.0) / 2.0)
        .when(|i| pairs(i) * (count(i) - 1.0) * count(i))
        .when(|i| pairs(i) * (count(i) - 1.0) * count(i) / 2.0)
        .when(|i| pairs(i) * count(i))
        .when(|i| pairs(i) * count(i) / 2.0)
        .say("only neighbours are paired; every run makes a pair with every other")
        .when(|i| neighbours(i, 1) / (count(i) - 1.0))
        .when(|i| neighbours(i, 1) / count(i))
        .when(|i| neighbours(i, 1) / (count(i) * (count(i) - 1.0)))
        .when(|i| neighbours(i, 0) / count(i))
        .say("the truth is left out of bias²: the products are those of the distances from it")
        .when(|(runs, _)| pairs(&(runs.clone(), 0.0)))
        .say("bias² is taken about the runs' own mean; it tells how far they lie from the truth")
        .when(|(runs, _)| pairs(&(runs.clone(), mean(runs))))
        .say("this is the bias, not its square")
        .when(|i| mean(&off(i)))
        .when(|i| mean(&off(i)).abs())
        .say("a bias² below 0 is cut off; then its mean over many pixels is too large")
        .when(|i| pairs(i).max(0.0))
        .say("a bias² below 0 has lost its sign; then its mean over many pixels is too large")
        .when(|i| pairs(i).abs())
        .say(
            "the mean is taken before the truth is: where the noise is small against the value, its rounding \
                 is all of the bias",
        )
        .when(|i| (mean(&i.0) - i.1) * (mean(&i.0) - i.1) - variance(i) / count(i));
    let whole = Part::<[f64; 3], Answer>::new(|&[several, scatter, bias]| (several > 0.0).then_some([scatter, bias]))
        .say("the two numbers are swapped")
        .when(|&[several, scatter, bias]| (several > 0.0).then_some([bias, scatter]));
    Mistakes::<Input, Answer>::new()
        .say("one run tells no variance, and none tells nothing: the answer there is None")
        .when(|i| right(i).or_else(|| Some([0.0, square(&off(i))])))
        .when(|i| right(i).or(Some([0.0, 0.0])))
        .when(|i| right(i).or(Some([f64::NAN; 2])))
        .when(|i| right(i).or_else(|| (i.0.len() == 1).then(|| [0.0, square(&off(i))])))
        .when(|i| right(i).or_else(|| (i.0.len() == 1).then_some([0.0; 2])))
        .when(|i| right(i).or_else(|| (i.0.len() == 1).then_some([f64::NAN; 2])))
        .of_parts([several, scatter, bias], whole)
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
    asked.extend(extremes("a value of about 1e9 with noise of about 1", scattered(1803, 1e9, 0.0)));
    asked
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
    spread(input, |off| off * off)
}

/// Pair by pair, as the words have it.
fn pairs(input: &Input) -> f64 {
    let off = off(input);
    let mut sum = 0.0;
    for one in 0..off.len() {
        sum += (0..off.len()).filter(|&other| other != one).map(|other| off[one] * off[other]).sum::<f64>();
    }
    sum / (off.len() as f64 * (off.len() as f64 - 1.0))
}

fn about_truth(input: &Input) -> f64 {
    off(input).iter().map(|off| off * off).sum::<f64>() / (count(input) - 1.0)
}

/// A function of the sum of squares, the sum and the number of runs.
fn by_sums((runs, _): &Input, made: fn(f64, f64, f64) -> f64) -> f64 {
    made(runs.iter().map(|run| run * run).sum(), runs.iter().sum(), runs.len() as f64)
}

fn count((runs, _): &Input) -> f64 {
    runs.len() as f64
}

/// The sum over one less than the number of runs, of what is made of the distances from their mean.
fn spread(input: &Input, made: fn(f64) -> f64) -> f64 {
    let off = off(input);
    let mean = mean(&off);
    off.iter().map(|off| made(off - mean)).sum::<f64>() / (count(input) - 1.0)
}

/// The sum of the products of each run and the next: up to the last but one, or of the last and the first, too.
fn neighbours(input: &Input, but: usize) -> f64 {
    let off = off(input);
    (0..off.len().saturating_sub(but)).map(|at| off[at] * off[(at + 1) % off.len()]).sum()
}

fn right(input: &Input) -> Answer {
    (input.0.len() > 1).then(|| [variance(input), pairs(input)])
}

/// Four runs of a pixel in every square: to the right they are ever farther from the truth, and further down ever farther
/// from each other. Red is the variance, and green the square of the bias.
fn mine(ask: Ask<Input, Answer>, _: &Setting<'_>) -> StandIn {
    StandIn::painted([48, 27], move |[x, y]| {
        let [bias, scatter] = [f64::from(x) / 47.0, f64::from(y) / 26.0];
        let runs = [1.0, -0.5, 0.25, -0.75].map(|run| 0.25 + bias + scatter * run);
        let [variance, bias] = ask.once((runs.to_vec(), 0.25)).flatten().unwrap_or_default();
        [variance, bias, 0.1]
    })
}
