//! The denoiser's variance and its bias, apart, over the number of its levels.

use super::Figure;
use super::label::Label;
use super::pen::{INK, Pen};
use super::picture::few;
use super::real_time::{Frame, MEASURED, Radiance, mean, mean_over, mean_square, raised};
use super::svg::{Drawing, Svg};
use glam::DVec2;
use pinhole::{Chapter, Result};

/// The most levels.
const MAX: u32 = 4;
/// Samples a pixel, how many renders of them, each of another seed, and the colours of their curves.
const SAMPLES: [(u32, u32, &str); 4] = [(1, 8, "#d9822b"), (4, 6, "#4a90c9"), (16, 3, "#4f9d5d"), (64, 2, "#8a6bb1")];
/// Renders whose mean is the reference, and the samples of each.
const BATCHES: u32 = 4;
const BATCH: u32 = 12;
/// Where the axes are: left, top, right, bottom.
const FRAME: [f64; 4] = [72.0, 40.0, 500.0, 350.0];
const HEIGHT: f64 = 420.0;

/// What is measured of the filter, each over levels from 0.
struct Apart {
    /// Beside mirrors, for each number of samples.
    variance: Vec<Vec<f64>>,
    /// bias², beside mirrors.
    bias: Vec<f64>,
    /// bias² of the whole image.
    bias_of_all: Vec<f64>,
}

/// Renders of many seeds through the filter.
fn measure(chapter: &Chapter) -> Result<Apart> {
    let renders = |samples: u32, count: u32, seed: u32| {
        let one = |run: u32| Frame::of(chapter, MEASURED, [samples, seed + run], 0.0);
        (0..count).map(one).collect::<Result<Vec<Frame>>>()
    };
    let through = |runs: &[Frame], levels: u32| runs.iter().map(|run| run.history.denoised(levels)).collect::<Vec<_>>();
    let batches = renders(few(BATCH), few(BATCHES).max(2), 100_000)?;
    let (plain, is_plain) = (through(&batches, 0), &batches[0].is_plain);
    let filtered: Vec<Vec<Radiance>> = (0..=MAX).map(|levels| through(&batches, levels)).collect();
    let bias = |counts: &[bool]| filtered.iter().map(|filtered| bias_squared(filtered, &plain, counts)).collect();
    let of = |(samples, runs, _): (u32, u32, &str)| {
        let runs = renders(few(samples), few(runs).max(2), 1000 * samples)?;
        Ok((0..=MAX).map(|levels| variance(&through(&runs, levels), is_plain)).collect())
    };
    let variance = SAMPLES.into_iter().map(of).collect::<Result<_>>()?;
    Ok(Apart { variance, bias: bias(is_plain), bias_of_all: bias(&vec![true; is_plain.len()]) })
}

/// The variance of one of several renders, about their mean.
fn variance(runs: &[Radiance], counts: &[bool]) -> f64 {
    let middle = mean(runs);
    runs.iter().map(|run| mean_square(run, &middle, counts)).sum::<f64>() / (runs.len() - 1) as f64
}

// ANCHOR: filter_bias
/// bias² of a linear filter: the mean product of what it changes in two renders of different seeds, over all pairs.
fn bias_squared(filtered: &[Radiance], plain: &[Radiance], counts: &[bool]) -> f64 {
    let pairs = (plain.len() * (plain.len() - 1)) as f64;
    let of_number = |part: usize, at: usize| {
        let changes = || filtered.iter().zip(plain).map(|(new, old)| f64::from(new[part][at] - old[part][at]));
        let (sum, squares) = (changes().sum::<f64>(), changes().map(|change| change * change).sum::<f64>());
        // The square of the sum holds the product of each two renders, and of each with itself.
        (sum * sum - squares) / pairs
    };
    mean_over(counts, |at| (0..3).map(|part| of_number(part, at)).sum::<f64>() / 3.0)
}
// ANCHOR_END: filter_bias

/// Variance, bias² and their sum over levels, for each number of samples.
pub fn draw_bias_and_variance(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let Apart { variance, bias, bias_of_all } = measure(chapter)?;
    let [left, top, right, bottom] = FRAME;
    let all = || {
        variance
            .iter()
            .flatten()
            .chain(&bias)
            .chain(&bias_of_all)
            .copied()
            .filter(|value| *value > 0.0)
            .map(libm::log10)
    };
    let low = all().fold(f64::INFINITY, f64::min).floor();
    let high = f64::max(all().fold(f64::NEG_INFINITY, f64::max).ceil(), low + 1.0);
    let at = |levels: usize, value: f64| {
        let part = (libm::log10(value) - low) / (high - low);
        DVec2::new(left + (right - left) * levels as f64 / f64::from(MAX), bottom - (bottom - top) * part)
    };
    let mut svg = Svg::new(figure.name, HEIGHT);
    let grid = Pen::new(INK, 0.8).faint(0.16);
    for decade in low as i32..=high as i32 {
        let ends = [0, MAX as usize].map(|level| at(level, libm::exp10(f64::from(decade))));
        svg.quiet_line(ends[0], ends[1], grid);
        let words = if decade == 0 { "1".into() } else { format!("10{}", raised(&decade.to_string())) };
        svg.label(Label::near(ends[0], &words, DVec2::NEG_X, 8.0).title(0.85));
    }
    for level in 0..=MAX as usize {
        let x = at(level, 1.0).x;
        svg.quiet_line(DVec2::new(x, top), DVec2::new(x, bottom), grid);
        svg.label(Label::near(DVec2::new(x, bottom), &level.to_string(), DVec2::Y, 6.0).title(0.85));
    }
    let curve = |svg: &mut Svg, values: &[f64], pen: Pen| {
        for (level, pair) in values.windows(2).enumerate().filter(|(_, pair)| pair.iter().all(|value| *value > 0.0)) {
            svg.quiet_line(at(level, pair[0]), at(level + 1, pair[1]), pen);
        }
    };
    let mut ends = Vec::new();
    for ((samples, _, colour), variance) in SAMPLES.into_iter().zip(&variance) {
        let sum: Vec<f64> = variance.iter().zip(&bias).map(|(variance, bias)| variance + bias.max(0.0)).collect();
        curve(&mut svg, variance, Pen::new(colour, 1.4).dashed("5 4"));
        curve(&mut svg, &sum, Pen::new(colour, 2.4));
        let best = (0..sum.len()).min_by(|&one, &other| sum[one].total_cmp(&sum[other])).unwrap_or(0);
        svg.dot(at(best, sum[best]), 4.0, colour);
        let words = format!("{samples} {}", if samples == 1 { "sample" } else { "samples" });
        ends.push((at(MAX as usize, variance[MAX as usize]), words, colour));
    }
    for (bias, words, pen) in [
        (&bias, "bias²", Pen::new(INK, 1.8)),
        (&bias_of_all, "bias² with the mirror", Pen::new(INK, 1.4).dashed("2 4")),
    ] {
        curve(&mut svg, bias, pen);
        ends.push((at(MAX as usize, bias[MAX as usize].max(libm::exp10(low))), words.to_owned(), INK));
    }
    ends.sort_by(|one, other| one.0.y.total_cmp(&other.0.y));
    let mut last = f64::NEG_INFINITY;
    for (end, words, colour) in ends {
        let y = f64::max(end.y, last + 18.0);
        last = y;
        let words = if colour == INK { words } else { format!("variance, {words}") };
        svg.label(Label::near(DVec2::new(end.x, y), &words, DVec2::X, 8.0).coloured(colour).title(0.92));
    }
    let middle = DVec2::new(0.5 * (left + right), bottom + 24.0);
    svg.label(Label::near(middle, "levels of the filter", DVec2::Y, 0.0).title(0.92));
    svg.label(
        Label::near(DVec2::new(left, 16.0), "mean square; unbroken: variance and bias² together", DVec2::X, 0.0)
            .title(0.92),
    );
    Ok(svg.finish(figure.about, &figure.stamp(MEASURED, "2 to 8 seeds a point")))
}
