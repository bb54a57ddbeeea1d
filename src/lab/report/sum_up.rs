//! From runs to what the report says.

use super::curve::{Curve, Level};
use super::deviation::{Deviation, deviation};
use super::distribution::sidak;
use super::ensemble::{Ensemble, Reference};
use super::interval::{Estimate, Interval, LEVEL, bca, mad, mean_of, median};
use super::ladder::Ladder;
use super::refused::{Refused, disjoint};
use super::run::{Run, Times};
use super::runner::{Runs, Variant};
use super::summary::{
    At, Comparison, LevelSummary, Report, SceneSummary, Spread, StageSummary, Statistic, VariantSummary,
};
use crate::measure::image_error::Numbers;
use pinhole::plan::{Stage, TileSystems};
use pinhole::rays::{place_samples_stage, world_stage};
use pinhole::{Error, Result};

/// Readings at equal time.
const TIMES: usize = 5;
/// The largest standard deviation of times over their mean that is not flagged.
const STEADY: f64 = 0.05;
/// The largest fraction of wall time that a run may wait without a flag.
const WAITING: f64 = 0.1;

/// A variant's curve, each run's deviation, and the reference.
pub struct Measured {
    /// For slope, efficiency and comparisons.
    pub curve: Curve,
    /// By level and run.
    pub deviations: Vec<Vec<Deviation>>,
    /// What the runs were compared with.
    pub reference: Reference,
}

/// Measures every variant's runs against its reference.
///
/// Errors: a seed that both a run and the reference have, or images without a common finite pixel.
pub fn measure(variants: &[Variant<'_>], ladder: &Ladder, runs: &Runs) -> Result<Vec<Measured>> {
    disjoint(&ladder.seeds(), &ladder.reference_seeds()).map_err(|refused| Error::Usage(refused.to_string()))?;
    let measured = variants.iter().enumerate().map(|(own, variant)| {
        let batches: Vec<Numbers> = runs.references[variant.reference].iter().map(|run| run.image.clone()).collect();
        let reference = Reference::of(&batches).ok_or_else(|| Error::Usage("the reference has no batches".into()))?;
        let mut levels = Vec::new();
        let mut deviations = Vec::new();
        for (&samples, runs) in ladder.samples.iter().zip(&runs.levels[own]) {
            let images: Vec<Numbers> = runs.iter().map(|run| run.image.clone()).collect();
            let each = images.iter().map(|image| deviation(&reference.mean, image));
            deviations.push(each.collect::<std::result::Result<Vec<_>, _>>().map_err(Error::Usage)?);
            levels.push(Level {
                samples: samples.into(),
                ensemble: Ensemble::of(&images, &reference),
                seconds: runs.iter().map(|run| run.times.render()).collect(),
            });
        }
        let (seeds, batches) = (ladder.seeds as usize, ladder.batches as usize);
        let curve = Curve { levels, seeds, batches, reference_samples: ladder.reference_samples() };
        Ok(Measured { curve, deviations, reference })
    });
    measured.collect()
}

/// What each variant's numbers are, and how the others compare with the first.
pub fn sum_up(mut report: Report, variants: &[Variant<'_>], runs: &Runs, measured: &[Measured]) -> Report {
    for (own, (variant, measured)) in variants.iter().zip(measured).enumerate() {
        let scene = report.scenes.get(own).cloned().unwrap_or_default();
        report.variants.push(summary(variant, own, runs, measured, scene));
    }
    let comparisons = (variants.len() - 1) * (report.ladder.samples.len() * 2 + TIMES);
    report.family_level = sidak(LEVEL, comparisons);
    for (variant, other) in variants.iter().zip(measured).skip(1) {
        compare(&mut report, &variant.name, &other.curve, &measured[0].curve);
    }
    report.timers = runs.timers;
    report.flags = flags(&report);
    report
}

fn summary(variant: &Variant<'_>, own: usize, runs: &Runs, measured: &Measured, scene: SceneSummary) -> VariantSummary {
    let Measured { curve, deviations, reference } = measured;
    let levels = curve.levels.iter().zip(deviations).zip(&runs.levels[own]).enumerate();
    let stages = &runs.stages[own];
    let rows_of = |counts: &dyn Fn(&Stage) -> bool| {
        let counted = stages.iter().filter(|(stage, _)| counts(stage));
        counted.map(|(_, lap)| lap.rows).sum::<u64>() as f64
    };
    let rays = [rows_of(&|stage| stage.is(world_stage)), rows_of(&|stage| stage.set == TileSystems::SampleLights)];
    let samples = rows_of(&|stage| stage.is(place_samples_stage)).max(1.0);
    VariantSummary {
        name: variant.name.clone(),
        sampling: format!("{:?}, {:?}", variant.sampling.sampler, variant.sampling.filter),
        levels: levels
            .map(|(at, ((level, each), runs))| level_summary(curve, at, level, each, runs, reference))
            .collect(),
        slope: Statistic::of(curve.slope(LEVEL).map(|slope| slope.interval(LEVEL))),
        reference_variance: curve.levels.first().and_then(|level| level.ensemble.reference_variance()).unwrap_or(0.0),
        scene: scene.fingerprint,
        film: scene.film,
        rays: rays.map(|rays| rays / samples),
        tests_a_ray: scene.shapes,
        stages: stages
            .iter()
            .map(|(stage, lap)| StageSummary {
                stage: stage.name.into(),
                rows: lap.rows,
                milliseconds: lap.time.as_secs_f64() * 1e3,
            })
            .collect(),
    }
}

fn level_summary(
    curve: &Curve,
    at: usize,
    level: &Level,
    each: &[Deviation],
    runs: &[Run],
    reference: &Reference,
) -> LevelSummary {
    let few = || Refused::TooFewSeeds { seeds: runs.len() };
    let interval = |estimate: Option<Estimate>| Statistic::of(estimate.map(|it| it.interval(LEVEL)).ok_or_else(few));
    let mean = |of: &dyn Fn(&Deviation) -> f64| each.iter().map(of).sum::<f64>() / each.len().max(1) as f64;
    let times = |of: fn(&Times) -> f64| runs.iter().map(|run| of(&run.times)).collect::<Vec<f64>>();
    let no_error = || "no efficiency: there is no error to divide by".to_string();
    let efficiency = curve.log_efficiency(at).map(|log| log.interval(LEVEL).of_logarithm()).ok_or_else(no_error);
    let mse = level.told_mse(LEVEL).map(|mse| mse.interval(LEVEL));
    LevelSummary {
        samples: level.samples as u32,
        efficiency: match &mse {
            Ok(_) => Statistic::of(efficiency),
            Err(refused) => Statistic::Refused(refused.to_string()),
        },
        mse: Statistic::of(mse),
        rel_mse: mean(&|it| it.rel_mse) - reference.relative_variance(),
        trimmed_rel_mse: mean(&|it| it.trimmed_rel_mse) - reference.relative_variance(),
        mae: mean(&|it| it.mae),
        largest: each.iter().map(|it| it.largest).fold(0.0, f64::max),
        tail_fraction: median(&each.iter().map(|it| it.tail_fraction).collect::<Vec<_>>()).unwrap_or(0.0),
        variance: interval(level.ensemble.variance()),
        bias_squared: interval(level.ensemble.bias_squared()),
        render: spread(&times(Times::render)),
        whole: spread(&times(|times| times.cpu)),
        wall: median(&times(|times| times.wall)).unwrap_or(0.0),
        odd: each.iter().fold([0; 4], |sum, it| [0, 1, 2, 3].map(|kind| sum[kind] + it.odd[kind])),
        rejected: runs.iter().map(|run| run.rejected).sum(),
    }
}

fn spread(times: &[f64]) -> Spread {
    let value = median(times).unwrap_or(0.0);
    let weighted = |weights: &[f64]| {
        let drawn = times.iter().zip(weights).flat_map(|(time, &weight)| std::iter::repeat_n(*time, weight as usize));
        median(&drawn.collect::<Vec<_>>())
    };
    let deviation = mean_of(times).map_or(0.0, |mean| libm::sqrt(mean.variance * times.len() as f64) / mean.value);
    Spread {
        median: bca(times.len(), LEVEL, weighted).unwrap_or(Interval { low: value, value, high: value }),
        mad: mad(times).unwrap_or(0.0),
        variation: if deviation.is_finite() { deviation } else { 0.0 },
    }
}

fn compare(report: &mut Report, name: &str, curve: &Curve, first: &Curve) {
    let level = report.family_level;
    let ratio = |log: Option<Estimate>| {
        let none = || "one of the two has no error that its reference can tell".to_string();
        Statistic::of(log.map(|log| log.interval(level).of_logarithm()).ok_or_else(none))
    };
    for (at, &samples) in report.ladder.samples.iter().enumerate() {
        report.comparisons.push(Comparison {
            variant: name.into(),
            at: At::Samples(samples),
            mse: ratio(curve.log_mse_ratio(first, at)),
            efficiency: Some(ratio(curve.log_efficiency_ratio(first, at))),
        });
    }
    for seconds in common_times(curve, first) {
        let log = curve.log_mse_ratio_at(first, seconds);
        report.comparisons.push(Comparison {
            variant: name.into(),
            at: At::Seconds(seconds),
            mse: Statistic::of(log.map(|log| log.interval(level).of_logarithm())),
            efficiency: None,
        });
    }
}

/// Times that both curves reach, evenly spread in their logarithm.
fn common_times(one: &Curve, other: &Curve) -> Vec<f64> {
    let ends = |curve: &Curve| {
        let time =
            |level: Option<&Level>| level.and_then(|level| mean_of(&level.seconds)).map_or(0.0, |mean| mean.value);
        [time(curve.levels.first()), time(curve.levels.last())]
    };
    let ([a0, a1], [b0, b1]) = (ends(one), ends(other));
    let (low, high) = (a0.max(b0), a1.min(b1));
    if low <= 0.0 || high <= low {
        return Vec::new();
    }
    let step = libm::log(high / low) / (TIMES + 1) as f64;
    (1..=TIMES).map(|at| low * libm::exp(step * at as f64)).collect()
}

/// What makes the times unfit to be compared, in sentences.
fn flags(report: &Report) -> Vec<String> {
    let mut flags = Vec::new();
    let cores = report.provenance.cores as f64;
    let load = report.provenance.load.iter().flatten().copied().fold(0.0, f64::max);
    if report.provenance.profile != "release" {
        flags.push("built without --release: these times say nothing about pinhole".into());
    }
    if load > 0.5 * cores {
        flags.push(format!("the machine was busy: load {load:.2} on {cores} cores"));
    }
    let levels = || report.variants.iter().flat_map(|it| it.levels.iter().map(move |level| (&it.name, level)));
    let all = levels().count();
    let mut flag = |what: &str, allowed: f64, of: &dyn Fn(&LevelSummary) -> f64| {
        let beyond = levels().filter(|(_, level)| of(level) > allowed).count();
        let worst = levels().max_by(|one, other| of(one.1).total_cmp(&of(other.1)));
        if let Some((name, level)) = worst.filter(|_| beyond > 0) {
            let percent = 100.0 * of(level);
            flags.push(format!(
                "{what} by more than {:.0} % in {beyond} of {all} rows; the worst, {name} at {} samples, by {percent:.0} %",
                100.0 * allowed,
                level.samples
            ));
        }
    };
    flag("times of one row scatter about their mean", STEADY, &|level| level.render.variation);
    let threads = report.threads as f64;
    flag("CPU time differs from wall time × threads", WAITING, &|level| {
        (1.0 - level.whole.median.value / (level.wall * threads)).abs()
    });
    flags
}
