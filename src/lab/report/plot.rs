//! Plots with logarithms on both axes, drawn as the book's figures are.

use super::summary::{LevelSummary, Report, VariantSummary};
use crate::figure::{Drawing, Fill, Pen, Placed, Svg};
use glam::DVec2;

/// Where the axes are: left, top, right, bottom.
const FRAME: [f64; 4] = [74.0, 34.0, 560.0, 330.0];
/// The height of a plot.
const HEIGHT: f64 = 408.0;
/// The variants' colours, which are told apart on light and dark pages.
const COLOURS: [&str; 6] = ["#d9822b", "#4a90c9", "#4f9d5d", "#b566b0", "#b8960c", "#8a8a8a"];
const INK: &str = "currentColor";

/// What a plot has along its x axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Against {
    /// CPU time of the render alone.
    Render,
    /// CPU time of plan, tables and render.
    Whole,
    /// Samples a pixel.
    Samples,
}

impl Against {
    fn words(self) -> &'static str {
        match self {
            Self::Render => "CPU seconds of the render alone",
            Self::Whole => "CPU seconds of plan, tables and render",
            Self::Samples => "samples a pixel",
        }
    }

    /// The x of a level, with the ends of its interval.
    fn of(self, level: &LevelSummary) -> [f64; 3] {
        let median = match self {
            Self::Render => level.render.median,
            Self::Whole => level.whole.median,
            Self::Samples => return [f64::from(level.samples); 3],
        };
        [median.low, median.value, median.high]
    }
}

/// Points of one variant: x with its ends, and the MSE with its ends.
type Points = Vec<([f64; 3], [f64; 3])>;

fn points(variant: &VariantSummary, against: Against) -> Points {
    let told = variant.levels.iter().filter_map(|level| Some((against.of(level), level.mse.value()?)));
    told.map(|(x, mse)| (x, [mse.low, mse.value, mse.high])).filter(|(x, mse)| x[1] > 0.0 && mse[1] > 0.0).collect()
}

/// Decades that the points lie in, a little room about them.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let logs: Vec<f64> = values.filter(|value| *value > 0.0).map(libm::log10).collect();
    let low = logs.iter().copied().fold(f64::INFINITY, f64::min);
    let high = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if logs.is_empty() { [-1.0, 1.0] } else { [low - 0.15, high + 0.15] }
}

/// MSE against time or samples, a line a variant, with error bars at 95 %; the dashed line falls with slope −1.
pub fn plot(report: &Report, against: Against) -> Drawing {
    let series: Vec<(&VariantSummary, Points)> =
        report.variants.iter().map(|variant| (variant, points(variant, against))).collect();
    let all = || series.iter().flat_map(|(_, points)| points);
    let xs = range(all().flat_map(|(x, _)| *x));
    let ys = range(all().flat_map(|(_, mse)| [mse[0].max(0.3 * mse[1]), mse[1], mse[2]]));
    let [left, top, right, bottom] = FRAME;
    let at = |x: f64, y: f64| {
        let fraction =
            |value: f64, [low, high]: [f64; 2]| ((libm::log10(value.max(1e-300)) - low) / (high - low)).clamp(0.0, 1.0);
        DVec2::new(left + (right - left) * fraction(x, xs), bottom - (bottom - top) * fraction(y, ys))
    };
    let mut svg = Svg::new(&format!("report-{}-{against:?}", report.name), HEIGHT);
    axes(&mut svg, xs, ys, against);
    if let Some(([_, x, _], [_, mse, _])) = all().next() {
        guide(&mut svg, &at, (*x, *mse), xs, ys);
    }
    let mut names = Vec::new();
    for (number, (variant, points)) in series.iter().enumerate() {
        let colour = COLOURS[number % COLOURS.len()];
        for pair in points.windows(2) {
            svg.quiet_line(at(pair[0].0[1], pair[0].1[1]), at(pair[1].0[1], pair[1].1[1]), Pen::new(colour, 1.8));
        }
        for (x, mse) in points {
            svg.quiet_line(at(x[1], mse[0]), at(x[1], mse[2]), Pen::new(colour, 1.4));
            svg.quiet_line(at(x[0], mse[1]), at(x[2], mse[1]), Pen::new(colour, 1.4));
            svg.circle(at(x[1], mse[1]), 3.2, Some(&Fill::new(colour, 1.0)), None);
        }
        names.push((points.last().map_or(top, |(x, mse)| at(x[1], mse[1]).y), colour, &variant.name));
    }
    // The names stand at the right, each as high as its line ends, and never on one another.
    names.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut last_y = f64::NEG_INFINITY;
    for (end, colour, name) in names {
        last_y = end.max(last_y + 17.0);
        words(&mut svg, DVec2::new(right + 10.0, last_y), "start", 13.0, colour, name);
    }
    let [width, height] = report.size;
    let (seeds, samples) = (report.ladder.seeds, report.ladder.reference_samples());
    let foot = format!(
        "scene {}, {width} × {height} pixels; {seeds} seeds a point; reference of {samples} samples",
        report.name
    );
    svg.finish(&format!("MSE of {} against {}", report.name, against.words()), &foot)
}

fn words(svg: &mut Svg, at: DVec2, anchor: &'static str, size: f64, colour: &'static str, text: &str) {
    svg.words(&Placed { point: at, at, anchor, size, colour, text: text.into(), crosses: 0 }, 1.0);
}

fn axes(svg: &mut Svg, xs: [f64; 2], ys: [f64; 2], against: Against) {
    let [left, top, right, bottom] = FRAME;
    let thin = Pen::new(INK, 0.8).faint(0.16);
    for (value, label) in ticks(xs, against == Against::Samples) {
        let x = left + (right - left) * (libm::log10(value) - xs[0]) / (xs[1] - xs[0]);
        svg.quiet_line(DVec2::new(x, top), DVec2::new(x, bottom), thin);
        words(svg, DVec2::new(x, bottom + 14.0), "middle", 12.0, INK, &label);
    }
    for (value, label) in ticks(ys, false) {
        let y = bottom - (bottom - top) * (libm::log10(value) - ys[0]) / (ys[1] - ys[0]);
        svg.quiet_line(DVec2::new(left, y), DVec2::new(right, y), thin);
        words(svg, DVec2::new(left - 8.0, y), "end", 12.0, INK, &label);
    }
    let corners = [[left, top], [right, top], [right, bottom], [left, bottom]].map(DVec2::from);
    svg.polygon(&corners, None, Some(Pen::new(INK, 0.9).faint(0.5)));
    words(svg, DVec2::new(0.5 * (left + right), bottom + 36.0), "middle", 13.0, INK, against.words());
    words(svg, DVec2::new(left, top - 16.0), "start", 13.0, INK, "MSE, with its interval at 95 %");
}

/// Where an axis is marked: at powers of four for samples, else at decades, and within them where there are few.
fn ticks([low, high]: [f64; 2], samples: bool) -> Vec<(f64, String)> {
    let mut ticks = Vec::new();
    if samples {
        let powers = (0..16).map(|power| f64::from(1_u32 << (2 * power)));
        ticks.extend(powers.map(|value| (value, format!("{value}"))));
    } else {
        let steps: &[f64] = match high - low {
            decades if decades < 0.8 => &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0],
            decades if decades < 2.2 => &[1.0, 2.0, 5.0],
            _ => &[1.0],
        };
        for decade in low.floor() as i32..=high.ceil() as i32 {
            for step in steps {
                ticks.push((step * libm::exp10(f64::from(decade)), scientific(*step, decade)));
            }
        }
    }
    ticks.retain(|(value, _)| (low..=high).contains(&libm::log10(*value)));
    ticks
}

/// A number of few digits: 0.02, 5, 10⁻⁶.
fn scientific(step: f64, decade: i32) -> String {
    if (-3..=3).contains(&decade) {
        let places = usize::try_from(-decade).unwrap_or(0);
        return format!("{:.places$}", step * libm::exp10(f64::from(decade)));
    }
    let power: String = format!("{decade}")
        .chars()
        .map(|letter| match letter {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            digit => char::from_u32(0x2070 + u32::from(digit) - u32::from('0')).unwrap_or(digit),
        })
        .collect();
    if step == 1.0 { format!("10{power}") } else { format!("{step}·10{power}") }
}

/// A dashed line of slope −1 through a point, as far as the frame goes.
fn guide(svg: &mut Svg, at: &dyn Fn(f64, f64) -> DVec2, (x, mse): (f64, f64), xs: [f64; 2], ys: [f64; 2]) {
    let (log_x, log_mse) = (libm::log10(x), libm::log10(mse));
    let end = xs[1].min(log_x + log_mse - ys[0]);
    let to = at(libm::exp10(end), libm::exp10(log_mse - (end - log_x)));
    svg.quiet_line(at(x, mse), to, Pen::new(INK, 1.0).faint(0.5).dashed("5 4"));
    let toward = DVec2::new(-8.0, 4.0);
    words(
        svg,
        at(libm::exp10(0.35 * log_x + 0.65 * end), libm::exp10(log_mse - 0.65 * (end - log_x))) + toward,
        "end",
        12.0,
        INK,
        "slope −1",
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_ten_stand_alone_and_multiples_have_their_factor() {
        let numbers = [(1.0, -6), (2.0, -6), (5.0, 12), (2.0, -2), (5.0, 0), (1.0, 3)];
        let shown = numbers.map(|(step, decade)| scientific(step, decade));
        assert_eq!(shown, ["10⁻⁶", "2·10⁻⁶", "5·10¹²", "0.02", "5", "1000"]);
    }
}
