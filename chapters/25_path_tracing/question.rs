//! Chapter 25: the throughput of a path after Russian roulette.

use super::mine::mine;
use pinhole::follow::survival_probability;
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;

pub(super) type Input = ([f64; 3], f64);

/// What the reader writes.
pub type Yours = fn([f64; 3], f64) -> [f64; 3];

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::after_roulette)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("after_roulette", question, move |&(throughput, u)| yours(throughput, u), mine)
}

/// Roulette with this probability of survival, and the factor of what goes on.
fn played(&(throughput, u): &Input, survival: f64, more: f64) -> [f64; 3] {
    if u < survival { throughput.map(|part| part * more) } else { [0.0; 3] }
}

fn largest(throughput: [f64; 3]) -> f64 {
    throughput[0].max(throughput[1]).max(throughput[2])
}

fn question() -> Question<Input, [f64; 3]> {
    Question {
        pinhole_has: ("src/pinhole/follow/roulette.rs", "survival_probability"),
        probes: asked(),
        tell: |(throughput, u)| format!("throughput {}, u {}", throughput.shown(), u.shown()),
        right: |input| {
            let survival = survival_probability(input.0);
            played(input, survival, 1.0 / survival)
        },
        apart: |yours, right| relative(yours, right),
        allowed: 1e-12,
        measured: "of each part",
        mistakes: vec![
            Mistake::new("a path that goes on counts as before, so the light of those that ended is lost", |input| {
                played(input, survival_probability(input.0), 1.0)
            }),
            Mistake::new(
                "nothing ever ends: where the number is not below the probability, nothing is left",
                |input| played(input, f64::INFINITY, 1.0 / survival_probability(input.0)),
            ),
            Mistake::new(
                "the two ends are swapped: a path goes on where the number lies below the probability",
                |input| {
                    let survival = survival_probability(input.0);
                    if input.1 < survival { [0.0; 3] } else { input.0.map(|part| part / survival) }
                },
            ),
            Mistake::new(
                "a probability above 1 divides light away; it is at most 1, and then nothing changes",
                |input| {
                    let survival = largest(input.0);
                    played(input, survival, 1.0 / survival)
                },
            ),
            Mistake::new("the probability is the mean of the three; asked is the largest", |input| {
                let survival = (input.0.iter().sum::<f64>() / 3.0).min(1.0);
                played(input, survival, 1.0 / survival)
            }),
            Mistake::new("the probability is that of green alone; asked is the largest of the three", |input| {
                let survival = input.0[1].min(1.0);
                played(input, survival, 1.0 / survival)
            }),
            Mistake::new("each colour plays for itself; a path is one ray, which goes on or does not", |input| {
                input.0.map(|part| if input.1 < part.min(1.0) { part / part.min(1.0) } else { 0.0 })
            }),
        ],
        hints: &[
            "the mean over all numbers must be the throughput itself: p × what goes on + (1 − p) × 0",
            "so what goes on is the throughput divided by p; compare the number with p first",
            "p is the largest of the three, but `.min(1.0)`; where the throughput is 0 nothing goes on, and \
             nothing is divided by 0",
        ],
    }
}

fn asked() -> Vec<Probe<Input>> {
    let grey = |throughput| [throughput; 3];
    let mut asked: Vec<_> = probes("a grey half", [(grey(0.5), 0.2), (grey(0.5), 0.7), (grey(0.5), 0.4)]).collect();
    let coloured = |seed, range: std::ops::Range<u64>, most: f64| {
        range.map(move |at| {
            let mut draws = Draws::new(seed, at);
            ([0; 3].map(|_| most * draws.unit()), draws.unit())
        })
    };
    asked.extend(probes("a coloured throughput", coloured(2501, 0..60, 1.0)));
    asked.extend(probes("a throughput above 1", coloured(2502, 0..40, 6.0)));
    asked.extend(probes("just at the probability", [(grey(0.25), 0.25), ([0.125, 0.5, 0.25], 0.5), (grey(1.0), 0.0)]));
    asked.extend(probes("nothing left", [(grey(0.0), 0.0), (grey(0.0), 0.5)]));
    asked
}
