//! Chapter 25: the throughput of a path after Russian roulette.

use bevy_ecs::prelude::*;
use pinhole::extract::{IntegratorTable, SamplingTable};
use pinhole::follow::{Scattered, survival_probability};
use pinhole::plan::{Shared, VectorRows, VectorRowsMut};
use pinhole::rays::{Depth, Paths, PixelSamples, SampleNumber, Tile, draws_of_one};
use pinhole::sample::Purpose;
use pinhole::{follow, rays};
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Probe, Question, Setting, Shown, StandIn, probes};
use pinhole_lab::measure::draws::Draws;

type Input = ([f64; 3], f64);

/// What the reader writes.
pub type Yours = fn([f64; 3], f64) -> [f64; 3];

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("after_roulette", question, move |&(throughput, u)| yours(throughput, u), mine)
        .and_in("numbers and throughputs", |_| ())
}

/// Roulette with this probability of survival, and the factor of what goes on.
fn played(&(throughput, u): &Input, survival: f64, more: f64) -> [f64; 3] {
    if u < survival { throughput.map(|part| part * more) } else { [0.0; 3] }
}

/// Roulette with this probability, of at most 1, throughout.
fn by(input: &Input, probability: f64) -> [f64; 3] {
    let survival = probability.min(1.0);
    played(input, survival, 1.0 / survival)
}

/// What is left where a path ends below this number, and is divided by that one elsewhere.
fn ended_below(&(throughput, u): &Input, end: f64, by: f64) -> [f64; 3] {
    if u < end || by == 0.0 { [0.0; 3] } else { throughput.map(|part| part / by) }
}

fn weighted(input: &Input, weights: [f64; 3]) -> f64 {
    input.0.iter().zip(weights).map(|(part, weight)| part * weight).sum()
}

fn largest(throughput: [f64; 3]) -> f64 {
    throughput[0].max(throughput[1]).max(throughput[2])
}

fn question() -> Question<Input, [f64; 3]> {
    Question {
        pinhole_has: ("src/pinhole/follow/paths.rs", "survival_probability"),
        probes: asked(),
        tell: |(throughput, u)| format!("throughput {}, u {}", throughput.shown(), u.shown()),
        right: |input| {
            let survival = survival_probability(input.0);
            played(input, survival, 1.0 / survival)
        },
        apart: |yours, right| relative(yours, right),
        allowed: 1e-12,
        measured: "of each part",
        mistakes: Mistakes::<Input, [f64; 3]>::new()
            .say("the probability is the middle one of the three; asked is the largest")
            .when(|input| {
                let mut sorted = input.0;
                sorted.sort_by(f64::total_cmp);
                by(input, sorted[1])
            })
            .say("the probability is four times the largest of the three; asked is the largest, and pinhole asks of four times the throughput")
            .when(|input| by(input, 4.0 * largest(input.0)))
            .say("the probability is kept above a smallest one; asked is the largest of the three, however small")
            .when(|input| by(input, largest(input.0).max(0.05)))
            .when(|input| by(input, largest(input.0).max(0.1)))
            .say("a path goes on where the number lies below 1 − p; it is to go on where the number lies below p")
            .when(|input| {
                let survival = survival_probability(input.0);
                played(input, 1.0 - survival, 1.0 / survival)
            })
            .say("a path that goes on counts as before, so the light of those that ended is lost")
            .when(|input| played(input, survival_probability(input.0), 1.0))
            .say("a path that goes on is multiplied by the probability; it must be divided by it")
            .when(|input| {
                let survival = survival_probability(input.0);
                played(input, survival, survival)
            })
            .say("a path that goes on is divided by the probability of its end; divide by that of going on")
            .when(|input| {
                let survival = survival_probability(input.0);
                played(input, survival, 1.0 / (1.0 - survival))
            })
            .when(|input| {
                let survival = survival_probability(input.0);
                played(input, survival, if survival < 1.0 { 1.0 / (1.0 - survival) } else { 1.0 })
            })
            .say("a path that goes on is divided by u; it must be divided by the probability")
            .when(|input| played(input, survival_probability(input.0), 1.0 / input.1))
            .say("nothing ever ends: where the number is not below the probability, nothing is left")
            .when(|input| played(input, f64::INFINITY, 1.0 / survival_probability(input.0)))
            .when(|input| {
                let survival = survival_probability(input.0);
                if input.1 < survival { input.0.map(|part| part / survival) } else { input.0 }
            })
            .say("the two ends are swapped: a path goes on where the number lies below the probability")
            .when(|input| ended_below(input, survival_probability(input.0), survival_probability(input.0)))
            .when(|input| ended_below(input, survival_probability(input.0), 1.0))
            .say("a path ends where the number lies below 1 − p; it is to go on where the number lies below p")
            .when(|input| {
                let survival = survival_probability(input.0);
                ended_below(input, 1.0 - survival, survival)
            })
            .say("a path goes on where the number is just the probability; it goes on only below that")
            .when(|input| {
                let survival = survival_probability(input.0);
                if input.1 <= survival { input.0.map(|part| part / survival) } else { [0.0; 3] }
            })
            .say("a probability above 1 divides light away; it is at most 1, and then nothing changes")
            .when(|input| {
                let survival = largest(input.0);
                played(input, survival, 1.0 / survival)
            })
            .say("the probability is cut off below 1; it is at most 1, so that a path of throughput 1 always goes on")
            .when(|input| by(input, largest(input.0).min(0.95)))
            .when(|input| by(input, largest(input.0).min(0.99)))
            .when(|input| by(input, largest(input.0).min(0.9)))
            .say("the throughput is cut off at 1; only the probability is, and nothing else changes")
            .when(|input| by(&(input.0.map(|part| part.min(1.0)), input.1), survival_probability(input.0)))
            .say("the probability is the mean of the three; asked is the largest")
            .when(|input| by(input, input.0.iter().sum::<f64>() / 3.0))
            .say("the probability is the luminance; asked is the largest of the three")
            .when(|input| by(input, weighted(input, [0.2126, 0.7152, 0.0722])))
            .when(|input| by(input, weighted(input, [0.299, 0.587, 0.114])))
            .say("a path ends by one probability and is divided by another; both must be the same")
            .when(|input| played(input, input.0.iter().sum::<f64>() / 3.0, 1.0 / survival_probability(input.0)))
            .when(|input| played(input, weighted(input, [0.2126, 0.7152, 0.0722]), 1.0 / survival_probability(input.0)))
            .say("the probability is the sum of the three; asked is the largest")
            .when(|input| by(input, weighted(input, [1.0; 3])))
            .say("the probability is the smallest of the three; asked is the largest")
            .when(|input| by(input, input.0[0].min(input.0[1]).min(input.0[2])))
            .say("the probability is that of red alone; asked is the largest of the three")
            .when(|input| by(input, input.0[0]))
            .say("the probability is that of green alone; asked is the largest of the three")
            .when(|input| by(input, input.0[1]))
            .say("the probability is that of blue alone; asked is the largest of the three")
            .when(|input| by(input, input.0[2]))
            .say("the probability is the length of the throughput; asked is the largest of the three")
            .when(|input| by(input, input.0.iter().map(|part| part * part).sum::<f64>().sqrt()))
            .say("the probability is the product of the three; asked is the largest")
            .when(|input| by(input, input.0.iter().product::<f64>()))
            .say("each colour plays for itself; a path is one ray, which goes on or does not")
            .when(|input| input.0.map(|part| if input.1 < part.min(1.0) { part / part.min(1.0) } else { 0.0 }))
            .say("each colour is divided by itself; all three are divided by the one probability")
            .when(
                |input| {
                    if input.1 < survival_probability(input.0) { input.0.map(|part| part.max(1.0)) } else { [0.0; 3] }
                },
            )
            .when(|input| if input.1 < survival_probability(input.0) { [1.0; 3] } else { [0.0; 3] }),
        hints: &[
            "the mean over all numbers must be the throughput itself: p × what goes on + (1 − p) × 0",
            "so what goes on is the throughput divided by p; compare the number with p first",
            "which p keeps all three parts at most 1, and is a probability itself? and what if there is nothing to \
             send on?",
        ],
    }
}

fn asked() -> Vec<Probe<Input>> {
    let grey = |throughput| [throughput; 3];
    let mut asked: Vec<_> = probes("a grey half", [(grey(0.5), 0.2), (grey(0.5), 0.7), (grey(0.5), 0.4)]).collect();
    let coloured = |seed, range: std::ops::Range<u64>, max: f64| {
        range.map(move |at| {
            let mut draws = Draws::new(seed, at);
            ([0; 3].map(|_| max * draws.unit()), draws.unit())
        })
    };
    asked.extend(probes("a coloured throughput", coloured(2501, 0..60, 1.0)));
    asked.extend(probes("a throughput above 1", coloured(2502, 0..40, 6.0)));
    asked.extend(probes("just at the probability", [(grey(0.25), 0.25), ([0.125, 0.5, 0.25], 0.5), (grey(1.0), 0.0)]));
    asked.extend(probes("almost nothing left", [(grey(0.02), 0.01), (grey(0.02), 0.03), ([0.01, 0.03, 0.02], 0.04)]));
    asked.extend(probes("nothing left", [(grey(0.0), 0.0), (grey(0.0), 0.5)]));
    asked
}

/// The throughput of paths after roulette; a path that ends keeps its row, with nothing left of its light.
fn mine(ask: Ask<Input, [f64; 3]>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::instead(
        follow::roulette_stage,
        move |(sampling, integrator): (Res<Shared<SamplingTable>>, Res<Shared<IntegratorTable>>),
              mut numbers: Local<Vec<f64>>,
              mut tiles: Query<(
            (&Tile, &Depth, Option<&SampleNumber>, Option<&PixelSamples>, &Paths),
            &mut Scattered,
        )>| {
            for ((tile, &depth, number, samples, paths), mut scattered) in &mut tiles {
                if depth.0 + 1 < integrator.roulette {
                    continue;
                }
                let draws = rays::Draws { sampling: &sampling, tile, number, samples, paths: Some(paths), depth };
                draws_of_one(&draws, Purpose::Roulette, &scattered.row, &mut numbers);
                for (ray, &u) in numbers.iter().enumerate() {
                    // In units of what is at risk, as pinhole asks.
                    let left = scattered.throughput.at(ray).map(|part| part / integrator.at_risk);
                    let row = scattered.row[ray] as usize;
                    if let Some(left) = ask.at((tile, samples, Some(paths)), row, (left, u)) {
                        scattered.throughput.put(ray, left.map(|part| part * integrator.at_risk));
                    }
                }
            }
        },
    )
}

/// Numbers from left to right, and throughputs of a reddish surface that grow from top to bottom, in the end above 1.
fn painted(ask: Ask<Input, [f64; 3]>) -> StandIn {
    StandIn::painted([64, 32], move |[x, y]| {
        let throughput = [1.0, 0.6, 0.1].map(|part| part * 1.5 * (f64::from(y) + 0.5) / 32.0);
        ask.once((throughput, (f64::from(x) + 0.5) / 64.0)).unwrap_or_default().map(|part| part / 1.5)
    })
}
