//! Which method to render a scene by: each renders it a few times, small, and their pictures are compared.
//!
//! Reads: pictures by each method, whose seeds no other has, and their times.
//! Writes: variance, efficiency beside the first method's, the light that a method lacks, and which method to take.

use super::agreement::{Lack, lack};
use super::ensemble::{Ensemble, Reference};
use super::interval::{Estimate, Interval, LEVEL, mean_of};
use super::runner::{Progress, Variant};
use super::summary::Statistic;
use super::table::{short, with_ends, with_percent};
use crate::measure::image_error::{Numbers, RELATIVE_FLOOR};
use pinhole::render::Execution;
use pinhole::scene::Sampling;
use pinhole::{Error, Result};
use serde::Serialize;

/// The side of a block, in pixels.
const SIDE: u32 = 8;
/// Half the interval of a variance over the variance, beyond which it is said that it is hardly known.
const UNSURE: f64 = 0.5;

/// What the pilot found of a method.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Found {
    /// Its numbers.
    Measured(Numbered),
    /// It renders this scene by the very stages of the method of this name.
    SameAs(String),
    /// The sentence with which it refuses the scene.
    Refused(String),
}

/// A method's numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Numbered {
    /// Processor time of one picture: the mean.
    pub seconds: f64,
    /// Mean of s² / (r² + 0.01) over pixels: s² is the variance from seed to seed, r the lower median of the means
    /// of those methods that lack no light, which one method's fireflies do not move.
    pub variance: Statistic,
    /// 1 / (variance · time) over that of the first method.
    pub efficiency: Statistic,
    /// The light that it lacks beside the method that shows most that it lacks.
    pub lacks: Lack,
}

/// A method's pictures, and the processor time that each took.
#[derive(Default)]
struct Trial {
    images: Vec<Numbers>,
    seconds: Vec<f64>,
}

/// Renders the scene by each variant, in turn so that all see the same machine.
///
/// Errors: a stop by the one who watches, or what is no fault of the scene's.
pub fn pilot(variants: &[Variant<'_>], samples: u32, seeds: u32, watch: &dyn Progress) -> Result<Vec<Found>> {
    let mut found: Vec<Option<Found>> = Vec::new();
    let mut plans: Vec<(Vec<&'static str>, &str)> = Vec::new();
    for variant in variants {
        found.push(match variant.stages_kept() {
            Ok(plan) => {
                let same = plans.iter().find(|(other, _)| *other == plan).map(|(_, name)| (*name).to_owned());
                plans.push((plan, &variant.name));
                same.map(Found::SameAs)
            }
            Err(error) => Some(refusal(error)?),
        });
    }
    let mut trials: Vec<Trial> = variants.iter().map(|_| Trial::default()).collect();
    let execution = Execution { threads: Some(1), ..Execution::default() };
    for run in 0..seeds {
        for (own, variant) in variants.iter().enumerate() {
            if found[own].is_some() {
                continue;
            }
            let seed = 1 + own as u64 * u64::from(seeds) + u64::from(run);
            match variant.run(Sampling { samples, seed, ..variant.sampling }, &execution, watch) {
                Ok(run) => {
                    trials[own].images.push(run.image);
                    trials[own].seconds.push(run.times.render());
                }
                Err(error) => found[own] = Some(refusal(error)?),
            }
            watch.run_done(samples.into());
        }
    }
    let measured: Vec<Trial> = trials.into_iter().filter(|trial| !trial.images.is_empty()).collect();
    let mut numbered = numbered(&measured).map_err(Error::Usage)?.into_iter().map(Found::Measured);
    // What is neither refused nor the same as another is measured.
    Ok(found.into_iter().filter_map(|found| found.or_else(|| numbered.next())).collect())
}

/// A scene's refusal; any other error stays one.
fn refusal(error: Error) -> Result<Found> {
    match error {
        Error::SceneError(_) | Error::Plan(_) => Ok(Found::Refused(error.to_string())),
        other => Err(other),
    }
}

/// The numbers of each of several methods' pictures, the first of which the others are compared with.
fn numbered(trials: &[Trial]) -> std::result::Result<Vec<Numbered>, String> {
    let lacking = |own: usize| {
        let others = trials.iter().enumerate().filter(|(other, _)| *other != own);
        let lacks = others.map(|(_, other)| lack(&trials[own].images, &other.images, SIDE, trials.len() - 1));
        let lacks = lacks.collect::<std::result::Result<Vec<Lack>, String>>()?;
        let surely = |lack: &Lack| lack.fraction - lack.standard_error;
        let by_lack = |one: &Lack, other: &Lack| {
            one.beyond_noise.cmp(&other.beyond_noise).then(surely(one).total_cmp(&surely(other)))
        };
        Ok(lacks.into_iter().max_by(by_lack).unwrap_or_default())
    };
    let lacks = (0..trials.len()).map(lacking).collect::<std::result::Result<Vec<Lack>, String>>()?;
    let mut means: Vec<Numbers> = Vec::new();
    let of = |trial: &Trial| Reference::of(&trial.images).map(|reference| reference.mean);
    means.extend(trials.iter().zip(&lacks).filter(|(_, lack)| !lack.beyond_noise).filter_map(|(trial, _)| of(trial)));
    if means.is_empty() {
        means.extend(trials.iter().filter_map(of));
    }
    let pixel = |at: usize| {
        [0, 1, 2].map(|part| {
            let mut values: Vec<f64> = means.iter().map(|mean| mean.pixels[at][part]).collect();
            values.sort_by(f64::total_cmp);
            let r = values[(values.len() - 1) / 2];
            1.0 / libm::sqrt(r * r + RELATIVE_FLOOR)
        })
    };
    let weights: Vec<[f64; 3]> = (0..means.first().map_or(0, |mean| mean.pixels.len())).map(pixel).collect();
    let variances: Vec<Option<Estimate>> = trials.iter().map(|trial| relative_variance(trial, &weights)).collect();
    let efficiency = |own: usize| {
        let [variance, time] = [variances[own]?, mean_of(&trials[own].seconds)?].map(|it| it.logarithm());
        let reciprocal = Estimate { value: 0.0, variance: 0.0, freedom: f64::INFINITY };
        Some(reciprocal.less(&variance?).less(&time?))
    };
    let efficiencies: Vec<Option<Estimate>> = (0..trials.len()).map(efficiency).collect();
    let row = |own: usize| {
        let none = || "there is no noise to compare".to_owned();
        let ratio = match (own, efficiencies[own], efficiencies[0]) {
            (0, Some(_), _) => Some(Estimate { value: 0.0, variance: 0.0, freedom: 1.0 }),
            (_, own, first) => own.zip(first).map(|(own, first)| own.less(&first)),
        };
        Numbered {
            seconds: mean_of(&trials[own].seconds).map_or(0.0, |mean| mean.value),
            variance: Statistic::of(variances[own].map(|it| it.interval(LEVEL)).ok_or_else(none)),
            efficiency: Statistic::of(ratio.map(|log| log.interval(LEVEL).of_logarithm()).ok_or_else(none)),
            lacks: lacks[own],
        }
    };
    Ok((0..trials.len()).map(row).collect())
}

fn relative_variance(trial: &Trial, weights: &[[f64; 3]]) -> Option<Estimate> {
    let weighted = |image: &Numbers| {
        let pixels = image.pixels.iter().zip(weights).map(|(pixel, weight)| [0, 1, 2].map(|at| pixel[at] * weight[at]));
        Numbers { pixels: pixels.collect(), ..image.clone() }
    };
    let images: Vec<Numbers> = trial.images.iter().map(weighted).collect();
    Ensemble::of(&images, &Reference::of(&images[..1])?).variance()
}

/// Which method to take.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Choice {
    /// The method's name; none where each lacks light that another finds, or there is no light.
    pub chosen: Option<String>,
    /// Why, in one sentence.
    pub why: String,
}

/// The method to take: of those that lack no light beyond noise the one that is most efficient for sure, by the lower end of
/// its interval; the first, unless another is more efficient beyond noise.
pub fn choose(methods: &[(&str, Found)]) -> Choice {
    let measured = || {
        methods.iter().filter_map(|(name, found)| match found {
            Found::Measured(numbers) => Some((*name, numbers)),
            _ => None,
        })
    };
    let Some((first, of_first)) = measured().next() else {
        return Choice { chosen: None, why: "no method takes this scene".into() };
    };
    let take = |name: &str, why: String| Choice { chosen: Some(name.into()), why };
    if measured().count() == 1 {
        return take(first, "no other method has anything to do here".into());
    }
    if measured().all(|(_, it)| it.variance.value().is_none_or(|variance| variance.value == 0.0)) {
        return take(first, "no method's pictures have any noise".into());
    }
    let surely = |it: &Numbered| it.efficiency.value().map_or(0.0, |own| own.low);
    let whole = measured().filter(|(_, it)| !it.lacks.beyond_noise);
    let Some((best, of_best)) = whole.max_by(|one, other| surely(one.1).total_cmp(&surely(other.1))) else {
        let min = measured().min_by(|one, other| one.1.lacks.fraction.total_cmp(&other.1.lacks.fraction));
        let min = min.map_or_else(String::new, |(name, it)| format!("; {name} lacks least, {}", words(&it.lacks)));
        return Choice { chosen: None, why: format!("each method lacks light that another finds{min}") };
    };
    let why = if of_first.lacks.beyond_noise {
        format!("it lacks no light that another finds, and {first} lacks {}", words(&of_first.lacks))
    } else if best == first {
        let others =
            if measured().any(|(_, it)| it.lacks.beyond_noise) { "no other that lacks none" } else { "no other" };
        format!("it lacks no light that another finds, and {others} is more efficient beyond noise")
    } else {
        let times = with_ends(&of_best.efficiency);
        format!("it lacks no light that another finds, and its efficiency is {times} times that of {first}")
    };
    take(best, why)
}

/// What a method lacks, as a line of the table has it.
fn words(lack: &Lack) -> String {
    let [percent, error] = [lack.fraction, lack.standard_error].map(|part| format!("{:.2}", 100.0 * part));
    match lack {
        Lack { blocks: 0, .. } => "-".into(),
        Lack { beyond_noise: false, .. } => format!("nothing (±{error} %)"),
        Lack { darker: 0, .. } => format!("{percent} ±{error} %"),
        Lack { darker, blocks, .. } => format!("{percent} ±{error} %, in {darker} of {blocks} blocks"),
    }
}

/// The table, and what is to be known of it.
pub fn table(methods: &[(&str, Found)], samples: u32) -> String {
    let mut text = format!("{:<27} {:>8}  {:<15} {:<28} lacks\n", "method", "ms CPU", "variance", "efficiency");
    let mut unsure = Vec::new();
    for (name, found) in methods {
        text += &match found {
            Found::Refused(why) => format!("{name:<27} refused: {why}\n"),
            Found::SameAs(other) => {
                format!("{name:<27} as {other}, by the same stages: nothing here is for it alone\n")
            }
            Found::Measured(Numbered { seconds, variance, efficiency, lacks }) => {
                if variance.value().is_some_and(|it| it.high - it.value > UNSURE * it.value) {
                    unsure.push(*name);
                }
                let (time, variance) = (short(1e3 * seconds), with_percent(variance));
                let efficiency = match efficiency.value() {
                    Some(Interval { low, high, .. }) if low == high => short(low),
                    _ => with_ends(efficiency),
                };
                format!("{name:<27} {time:>8}  {variance:<15} {efficiency:<28} {}\n", words(lacks))
            }
        };
    }
    text +=
        "variance: mean of s² / (r² + 0.01); ± is half the interval at 95 %, after what is lacking a standard error\n";
    if !unsure.is_empty() {
        let names = unsure.join(" and ");
        text += &format!(
            "the variance of {names} is hardly known: a few bright paths make most of it, and there may be brighter ones\n"
        );
    }
    if methods.iter().any(|(_, found)| matches!(found, Found::Measured(it) if it.lacks.beyond_noise)) {
        text += &format!(
            "what a method lacks, {samples} samples a pixel do not show: none of its paths brings it, or one of very many\n"
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(efficiency: [f64; 3], fraction: f64) -> Found {
        let lacks = Lack { fraction, beyond_noise: fraction > 0.0, ..Lack::default() };
        let one = Statistic::Value(Interval::from([0.5, 1.0, 1.5]));
        Found::Measured(Numbered {
            seconds: 1.0,
            variance: one,
            efficiency: Statistic::Value(efficiency.into()),
            lacks,
        })
    }

    #[test]
    fn the_most_efficient_that_lacks_nothing_is_chosen_and_the_first_in_doubt() {
        let refused = || Found::Refused("no".into());
        let one = || measured([1.0; 3], 0.0);
        for (methods, chosen) in [
            (vec![("a", one()), ("b", measured([0.9, 2.0, 4.0], 0.0)), ("c", refused())], Some("a")),
            (
                vec![("a", one()), ("b", measured([1.1, 2.0, 4.0], 0.0)), ("c", measured([0.9, 3.0, 9.0], 0.0))],
                Some("b"),
            ),
            (vec![("a", one()), ("b", measured([90.0, 100.0, 110.0], 0.1)), ("c", refused())], Some("a")),
            (vec![("a", measured([1.0; 3], 0.1)), ("b", measured([0.1, 0.2, 0.3], 0.0))], Some("b")),
            (vec![("a", measured([1.0; 3], 0.1)), ("b", measured([0.1, 0.2, 0.3], 0.01))], None),
            (vec![("a", refused())], None),
        ] {
            assert_eq!(choose(&methods).chosen.as_deref(), chosen, "{methods:?}");
        }
    }

    /// Pictures of known noise: half the variance in half the time is four times the efficiency.
    #[test]
    fn efficiency_is_that_of_known_noise() {
        let mut draws = crate::measure::draws::Draws::new(7, 0);
        let mut trial = |spread: f64, time: f64| {
            let mut image = || {
                let pixels = (0..256).map(|_| [0; 3].map(|_| 1.0 + spread * (draws.unit() - 0.5))).collect();
                Numbers { size: [16, 16], pixels, white: None }
            };
            let images = (0..16).map(|_| image()).collect();
            Trial { images, seconds: (0..16).map(|run| time * (1.0 + 0.01 * f64::from(run % 3))).collect() }
        };
        let found = numbered(&[trial(1.0, 2.0), trial(libm::sqrt(0.5), 1.0)]).expect("one size");
        let ratio = found[1].efficiency.value().expect("told");
        assert!(ratio.holds(4.0) && ratio.high / ratio.low < 1.3, "{ratio:?}");
        let variance = found[0].variance.value().expect("told");
        // The lower of two means is a little below the truth, the same for both methods.
        assert!((variance.value * 12.0 * 1.01 - 1.0).abs() < 0.1, "{variance:?}");
        assert!(found.iter().all(|it| !it.lacks.beyond_noise), "{found:?}");
    }
}
