//! Where the milliseconds of a frame go: what a chapter's stages cost, as it was measured and is kept beside the chapter.

use super::Figure;
use super::label::Label;
use super::pen::{Fill, INK, Pen, WIDTH};
use super::svg::{Drawing, Svg};
use crate::measure::cost::{kept_costs, kept_stages, place};
use glam::DVec2;
use pinhole::{Chapter, Error, Result};

/// The frame that the costs are told for: one sample of each of its pixels, on one thread.
const FRAME: [f64; 2] = [640.0, 360.0];
/// Frames of so many milliseconds are marked: 60 and 25 a second.
const MARKS: [(f64, &str); 2] = [(1000.0 / 60.0, "60 a second"), (1000.0 / 25.0, "25 a second")];
/// Where the bars are: left, top, right, and the height of each.
const BARS: [f64; 4] = [210.0, 40.0, 590.0, 26.0];

/// What stages do, and the words that their names begin with; the first that fits counts.
const PARTS: [(&str, &[&str]); 7] = [
    ("rays to pixels", &["Place samples", "Compute NDC", "Compute screen", "Generate", "Transform"]),
    ("projection", &["Rasterise"]),
    ("closest hits of rays", &["Clear hits", "Intersect", "Classify"]),
    (
        "surfaces and textures",
        &["Compute surfaces", "Interpolate", "Compute foot", "Look up", "Compute texture", "Evaluate textures"],
    ),
    ("shadow rays", &["Clear shadow", "Trace shadow"]),
    ("lights and BSDFs", &["Sample", "Compute MIS", "Evaluate direct", "Add emission", "Add the gradient"]),
    ("film", &["Accumulate"]),
];

/// A stage and its nanoseconds for each sample of a pixel.
fn stages(text: &str) -> Option<Vec<(String, f64)>> {
    let (_, heading) = text.lines().next()?.split_once(": ")?;
    let mut numbers = heading.split_whitespace().filter_map(|word| word.parse::<f64>().ok());
    let samples: f64 = [numbers.next()?, numbers.next()?, numbers.next()?].iter().product();
    let timed = kept_stages(text).into_iter();
    Some(timed.filter_map(|own| Some((own.name, own.rows * own.nanoseconds? / samples))).collect())
}

/// Nanoseconds of each part, and of what is in none of them.
fn parts(stages: &[(String, f64)]) -> Vec<(&'static str, f64)> {
    let part_of = |name: &str| PARTS.iter().position(|(_, begins)| begins.iter().any(|begin| name.starts_with(begin)));
    let of = |part: Option<usize>| stages.iter().filter(|(name, _)| part_of(name) == part).map(|(_, each)| each).sum();
    let named = PARTS.iter().enumerate().map(|(at, (name, _))| (*name, of(Some(at))));
    named.chain([("all others", of(None))]).collect()
}

/// Three digits, as a page has them.
fn thousands(number: f64) -> String {
    let rounded = (number / 100.0).round() as u64;
    if rounded >= 10 { format!("{},{}00", rounded / 10, rounded % 10) } else { format!("{rounded}00") }
}

/// Each part's milliseconds, and the whole beside the time that a frame has.
pub fn draw_budget(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let text = kept_costs(chapter.name).unwrap_or_default();
    let measured = stages(&text).filter(|stages| !stages.is_empty());
    let missing = || {
        let place = place(chapter.name);
        let place = place.display();
        Error::Usage(format!("{place} holds no costs; `cargo run --release -- measure {}` measures them", chapter.name))
    };
    let mut bars = parts(&measured.ok_or_else(missing)?);
    bars.push(("altogether", bars.iter().map(|(_, each)| each).sum()));
    let milliseconds = |each: f64| each * FRAME[0] * FRAME[1] * 1e-6;
    let [left, top, right, height] = BARS;
    let max = bars.iter().map(|&(_, each)| milliseconds(each)).fold(MARKS[1].0, f64::max);
    let x = |time: f64| left + (right - left) * time / max;
    let bottom = top + height * bars.len() as f64;
    let mut svg = Svg::new(figure.name, bottom + 58.0);
    for (time, words) in MARKS {
        svg.quiet_line(
            DVec2::new(x(time), top - 6.0),
            DVec2::new(x(time), bottom),
            Pen::new(INK, 1.0).faint(0.6).dashed("3 3"),
        );
        svg.label(Label::near(DVec2::new(x(time), top - 6.0), words, DVec2::NEG_Y, 3.0).title(0.85));
    }
    for (row, &(name, each)) in bars.iter().enumerate() {
        let (low, time) = (top + height * row as f64 + 4.0, milliseconds(each));
        let corners = [[left, low], [x(time), low], [x(time), low + height - 8.0], [left, low + height - 8.0]];
        let colour = if row + 1 == bars.len() { "#5f7f9f" } else { "#d9822b" };
        svg.polygon(&corners.map(DVec2::from), Some(&Fill::new(colour, 0.9)), None);
        let middle = low + 0.5 * height - 4.0;
        svg.label(Label::near(DVec2::new(left, middle), name, DVec2::NEG_X, 8.0).title(0.9));
        svg.label(Label::near(DVec2::new(x(time), middle), &format!("{time:.1} ms"), DVec2::X, 6.0).title(0.85));
    }
    let whole = bars.last().map_or(f64::INFINITY, |(_, each)| *each);
    let fitting = MARKS.map(|(time, _)| thousands(time * 1e6 / whole));
    let words =
        format!("one sample each of {} pixels fits a frame at 60 a second, of {} at 25", fitting[0], fitting[1]);
    svg.label(Label::near(DVec2::new(0.5 * WIDTH, bottom + 4.0), &words, DVec2::Y, 0.0).title(0.9));
    let machine = text.lines().find_map(|line| line.strip_prefix("machine: ")).unwrap_or_default();
    let machine = machine.split(',').next().unwrap_or_default();
    let note = format!("one thread of {machine}, its costs.txt");
    Ok(svg.finish(figure.about, &figure.stamp(FRAME.map(|side| side as u32), &note)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_costs_are_told_for_a_sample_of_a_pixel() {
        let text = "cost of x: 20 x 10 pixels of 2 samples on one thread, 15 renders\nerrors: the worst of 3\n\
                    what ran    rows ns a row\nRasterise triangles   400    10.0   9 to 11   -\n\
                    Trace shadow rays: meshes   200   8.00    1 to 9   -\nClear shadow rays  0    -   -   -\n\
                    Sum up the paths 800 0.5  0.4 to 1   -\nmachine: M, 2 threads\n";
        let stages = stages(text).expect("costs");
        assert_eq!(stages.len(), 3, "{stages:?}");
        let parts = parts(&stages);
        let of = |name: &str| parts.iter().find(|(own, _)| *own == name).map(|(_, each)| *each);
        assert_eq!([of("projection"), of("shadow rays"), of("all others")], [Some(10.0), Some(4.0), Some(1.0)]);
        assert_eq!(of("film"), Some(0.0));
    }
}
